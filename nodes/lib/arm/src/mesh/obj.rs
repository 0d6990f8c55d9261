//! Wavefront OBJ: vertices and faces; names, normals, textures and materials are passed over.

use super::{MAX_VERTICES, Mesh, MeshError, fan, number};
use nalgebra::Vector3;

pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    let mut polygon = Vec::new();
    let mut continued = String::new();
    for (i, line) in text.lines().enumerate() {
        let place = || format!("line {}", i + 1);
        if let Some(part) = line.trim_end().strip_suffix('\\') {
            continued.push_str(part);
            continued.push(' ');
            continue;
        }
        let joined;
        let line = if continued.is_empty() {
            line
        } else {
            joined = std::mem::take(&mut continued) + line;
            &joined
        };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut coordinates = [0.0; 3];
                for coordinate in &mut coordinates {
                    *coordinate = number(words.next().unwrap_or(""), place)?;
                }
                if mesh.vertices.len() == MAX_VERTICES {
                    return Err(MeshError::TooMany { what: "vertices", max: MAX_VERTICES });
                }
                mesh.vertices.push(Vector3::from(coordinates));
            }
            Some("f") => {
                polygon.clear();
                for word in words.take_while(|word| !word.starts_with('#')) {
                    polygon.push(index(word, mesh.vertices.len(), place)?);
                }
                if polygon.len() < 3 {
                    let problem = "a face with fewer than three corners".into();
                    return Err(MeshError::Syntax { place: place(), problem });
                }
                fan(&polygon, &mut mesh.triangles)?;
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// The vertex of `v`, `v/t`, `v//n` or `v/t/n`: from 1 on, or from the end when negative.
fn index(word: &str, n: usize, place: impl Fn() -> String) -> Result<u32, MeshError> {
    let written = word.split('/').next().unwrap_or("");
    let got: i64 = written
        .parse()
        .map_err(|_| MeshError::Syntax { place: place(), problem: "a face whose corner is no whole number".into() })?;
    let from_front = if got < 0 { n as i64 + got } else { got - 1 };
    match u32::try_from(from_front) {
        Ok(i) if (i as usize) < n => Ok(i),
        _ => Err(MeshError::Index { place: place(), got, n }),
    }
}

//! STL, text and binary.

use super::{MAX_COORDINATE, MAX_TRIANGLES, Mesh, MeshError, number};
use nalgebra::Vector3;

/// Header and count of a binary file, bytes.
const HEADER: usize = 84;
/// One triangle of a binary file: normal, three corners, two bytes of attributes.
const RECORD: usize = 50;

pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    // Binary headers may begin with "solid" too, so the length decides.
    let declared = bytes.get(80..HEADER).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let held = bytes.len().saturating_sub(HEADER) / RECORD;
    let exact = declared.is_some_and(|n| n == held && bytes.len() == HEADER + RECORD * n);
    let names_facets = || bytes[..bytes.len().min(2000)].windows(5).any(|word| word == b"facet" || word == b"endso");
    let text = bytes.trim_ascii_start().starts_with(b"solid") && names_facets();
    match declared {
        _ if text && !exact => read_text(&String::from_utf8_lossy(bytes)),
        Some(declared) if declared > MAX_TRIANGLES => Err(MeshError::TooMany { what: "triangles", max: MAX_TRIANGLES }),
        Some(declared) if declared <= held => read_binary(&bytes[HEADER..HEADER + RECORD * declared]),
        Some(declared) => Err(MeshError::CutOff { declared, held }),
        None => Err(MeshError::Syntax { place: "byte 0".into(), problem: "neither text nor a binary header".into() }),
    }
}

fn read_binary(records: &[u8]) -> Result<Mesh, MeshError> {
    let n = records.len() / RECORD;
    let mut mesh = Mesh { vertices: Vec::with_capacity(3 * n), triangles: Vec::with_capacity(n) };
    for (i, record) in records.chunks_exact(RECORD).enumerate() {
        for corner in record[12..48].chunks_exact(12) {
            let value = |k: usize| f64::from(f32::from_le_bytes([0, 1, 2, 3].map(|byte| corner[4 * k + byte])));
            let vertex = Vector3::new(value(0), value(1), value(2));
            if let Some(got) = vertex.iter().find(|v| v.is_nan() || v.abs() > MAX_COORDINATE) {
                return Err(MeshError::Number { place: format!("triangle {i}"), got: got.to_string() });
            }
            mesh.vertices.push(vertex);
        }
        let first = 3 * i as u32;
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    Ok(mesh)
}

/// Only `vertex` lines and `endloop` matter; the rest is not checked.
fn read_text(text: &str) -> Result<Mesh, MeshError> {
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    let mut in_loop = 0;
    let mut ended = false;
    for (i, line) in text.lines().enumerate() {
        let place = || format!("line {}", i + 1);
        let syntax = |problem: &str| MeshError::Syntax { place: place(), problem: problem.into() };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("vertex") => {
                let mut coordinates = [0.0; 3];
                for coordinate in &mut coordinates {
                    *coordinate = number(words.next().unwrap_or(""), place)?;
                }
                in_loop += 1;
                if in_loop > 3 {
                    return Err(syntax("a facet with more than three corners"));
                }
                mesh.vertices.push(Vector3::from(coordinates));
            }
            Some("endloop") => {
                if in_loop != 3 {
                    return Err(syntax("a facet with fewer than three corners"));
                }
                if mesh.triangles.len() == MAX_TRIANGLES {
                    return Err(MeshError::TooMany { what: "triangles", max: MAX_TRIANGLES });
                }
                let first = 3 * mesh.triangles.len() as u32;
                mesh.triangles.push([first, first + 1, first + 2]);
                in_loop = 0;
            }
            Some("endsolid") => ended = true,
            _ => {}
        }
    }
    if in_loop > 0 || !ended {
        return Err(MeshError::Syntax { place: "the end".into(), problem: "cut off: 'endsolid' is missing".into() });
    }
    Ok(mesh)
}

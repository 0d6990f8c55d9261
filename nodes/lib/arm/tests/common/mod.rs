//! Small meshes written by hand, in every format.
#![allow(dead_code, reason = "each test uses some of it")]

/// A cube of edge 2 about the origin as quads of corners.
const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];
const QUADS: [[usize; 4]; 6] = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn triangles() -> Vec<[usize; 3]> {
    QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// As text STL.
pub fn stl_text() -> String {
    let facet = |triangle: &[usize; 3]| {
        let vertices: String =
            triangle.iter().map(|&i| CORNERS[i]).map(|[x, y, z]| format!("   vertex {x} {y} {z}\n")).collect();
        format!(" facet normal 0 0 0\n  outer loop\n{vertices}  endloop\n endfacet\n")
    };
    format!("solid cube\n{}endsolid cube\n", triangles().iter().map(facet).collect::<String>())
}

/// As binary STL, its header beginning like text.
pub fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles().len() as u32).to_le_bytes());
    for triangle in triangles() {
        bytes.extend([0; 12]);
        triangle.iter().flat_map(|&i| CORNERS[i]).for_each(|v| bytes.extend((v as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// As OBJ: quads, with textures and normals that do not matter, and indices from both ends.
pub fn obj() -> String {
    let vertices: String = CORNERS.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let face = |(n, quad): (usize, &[usize; 4])| {
        let corner = |&i: &usize| if n % 2 == 0 { format!(" {}/1/1", i + 1) } else { format!(" {}//", i as i64 - 8) };
        format!("f{}\n", quad.iter().map(corner).collect::<String>())
    };
    let faces: String = QUADS.iter().enumerate().map(face).collect();
    format!("# a cube\nmtllib cube.mtl\no cube\n{vertices}vt 0 0\nvn 0 0 1\nusemtl grey\ns off\n{faces}l 1 2\n")
}

/// As COLLADA in centimetres: the cube of edge 2 in a node that is moved by (0, 0, 5) within one that is scaled by 10, and
/// once more, moved by (30, 0, 0), from a library.
pub fn dae() -> String {
    let positions: String = CORNERS.iter().flatten().map(|v| format!("{v} ")).collect();
    let p: String = QUADS.iter().flatten().map(|i| format!("{i} 0 ")).collect();
    format!(
        r##"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
  <library_geometries><geometry id="cube"><mesh>
    <source id="names"><Name_array id="n" count="2">a b</Name_array></source>
    <source id="where"><float_array id="w" count="24">{positions}</float_array>
      <technique_common><accessor source="#w" count="8" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#where"/></vertices>
    <polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" source="#names" offset="1"/>
      <vcount>4 4 4 4 4 4</vcount><p>{p}</p></polylist>
  </mesh></geometry></library_geometries>
  <library_nodes><node id="again"><translate>30 0 0</translate><instance_geometry url="#cube"/></node></library_nodes>
  <library_visual_scenes><visual_scene id="scene">
    <node><scale>10 10 10</scale><node><matrix>1 0 0 0 0 1 0 0 0 0 1 5 0 0 0 1</matrix>
      <instance_geometry url="#cube"/></node></node>
    <node><rotate>0 0 1 90</rotate><instance_node url="#again"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"##
    )
}

/// A robot of two links whose meshes are these files, the second in millimetres.
pub const MESH_ROBOT: &str = r#"<robot name="m">
  <link name="base"><collision><geometry><mesh filename="package://p/cube.stl"/></geometry></collision></link>
  <link name="tip">
    <inertial><origin xyz="0 0 0.1"/><mass value="1.2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.5"/><geometry><mesh filename="cube.obj" scale="0.1 0.1 -0.2"/></geometry></collision>
    <collision><geometry><mesh filename="cube.dae"/></geometry></collision>
  </link>
  <joint name="j" type="revolute"><origin xyz="0 0 3"/><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>"#;

/// Finds the meshes of [`MESH_ROBOT`].
pub fn find(name: &str) -> Result<Vec<u8>, String> {
    match name {
        "package://p/cube.stl" => Ok(stl_binary()),
        "cube.obj" => Ok(obj().into_bytes()),
        "cube.dae" => Ok(dae().into_bytes()),
        other => Err(format!("no {other} here")),
    }
}

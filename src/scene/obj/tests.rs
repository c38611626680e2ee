use std::io;

use glam::{DVec2, DVec3};

use super::*;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Parses a model whose material library is `mtl`.
fn parsed(obj: &str, mtl: &str) -> Result<Vec<Part>> {
    parse(Path::new("m.obj"), obj.as_bytes(), |name| match name {
        "m.mtl" => Ok(mtl.into()),
        _ => Err(Error::reading(name, io::ErrorKind::NotFound.into())),
    })
}

fn message(obj: &str, mtl: &str) -> String {
    parsed(obj, mtl).expect_err(obj).to_string()
}

#[test]
fn a_square_with_a_material() {
    let obj = "mtllib m.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
               vt 0 0\nvt 1 1\nvn 0 0 2\nusemtl red\nl 1 2 3\nf 1/1/1 2/2/1 3/2/1 -1/1/1\n";
    let parts = parsed(obj, "newmtl red\nKa 1\nKd 1 0 0\nKs .5 .5 .5\nNs 20\n").unwrap();
    let [part] = &parts[..] else {
        panic!("{}", parts.len())
    };
    assert_eq!(part.name, "square");
    assert_eq!(part.mesh.positions.len(), 4);
    assert_eq!(part.mesh.faces, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(part.mesh.normals, [DVec3::Z; 4]);
    let material = part.material.as_ref().unwrap();
    assert_eq!(material.diffuse, DVec3::X);
    assert_eq!(material.shininess, 20.0);
    assert!(material.texture.is_none());
}

#[test]
fn what_is_missing_is_made_up() {
    let obj = format!("{TRIANGLE}v 0 0 1\nf 1 2 3\nf 1 3 4\n");
    let mesh = &parsed(&obj, "").unwrap()[0].mesh;
    assert_eq!(mesh.positions.len(), 6);
    assert_eq!(mesh.normals[0], DVec3::Z);
    assert_eq!(mesh.normals[5], DVec3::X);
    assert_eq!(mesh.texture_coords, [DVec2::ZERO; 6]);
}

#[test]
fn bad_models_are_told_in_one_line() {
    let face = |face: &str| format!("{TRIANGLE}vt 0 0\n{face}\n");
    for (obj, mtl, expected) in [
        ("", "", "m.obj: found no faces"),
        (TRIANGLE, "", "m.obj: found no faces"),
        (
            "v 1 2\n",
            "",
            "m.obj:1: found \"1 2\", expected 3 finite numbers",
        ),
        ("\nv 1 nan 2\n", "", "m.obj:2: found \"1 nan 2\""),
        ("v 1 1e999 2\n", "", "m.obj:1: found \"1 1e999 2\""),
        ("v 1 1e13 2\n", "", "m.obj:1: found \"1 1e13 2\""),
        ("v 1 \\\n\\\n2\nv 1\n", "", "m.obj:1: found \"1"),
        ("# \\\n\nv 1\n", "", "m.obj:3: found \"1\""),
        ("vt x\n", "", "m.obj:1: found \"x\", expected 1"),
        (
            &face("f 1 2 4"),
            "",
            "m.obj:5: found the index \"4\" in \"4\", expected 1 to 3",
        ),
        (
            &face("f 1 2 4/2"),
            "",
            "m.obj:5: found the index \"4\" in \"4/2\"",
        ),
        (
            &face("f 1 2 3//1"),
            "",
            "m.obj:5: found the index \"1\" in \"3//1\", expected none",
        ),
        (&face("f 1 2 0"), "", "m.obj:5: found the index \"0\""),
        (&face("f 1 2 -4"), "", "m.obj:5: found the index \"-4\""),
        (
            &face("f 1 2 -9223372036854775808"),
            "",
            "m.obj:5: found the index",
        ),
        (
            &face("f 1 2 9223372036854775807"),
            "",
            "m.obj:5: found the index",
        ),
        (&face("f 1 2 x"), "", "m.obj:5: found the index \"x\""),
        (
            &face("f 1/2 2/1 3/1"),
            "",
            "m.obj:5: found the index \"2\" in \"1/2\"",
        ),
        (&face("f 1 2"), "", "m.obj:5: found the face \"1 2\""),
        (&face("f 1 2 # 3"), "", "m.obj:5: found the face"),
        (&face("f"), "", "m.obj:5: found the face"),
        (&face("f /1 2 3"), "", "m.obj:5: found the corner \"/1\""),
        (
            &face("f 1/1/1/1 2 3"),
            "",
            "m.obj:5: found the corner \"1/1/1/1\"",
        ),
        (
            "mtllib m.mtl\n",
            "newmtl red\nKd 1 0\n",
            "m.mtl:2: found \"1 0\"",
        ),
        (
            "mtllib m.mtl\n",
            "newmtl a\nmap_Kd m.mtl\n",
            "m.mtl: found no picture",
        ),
    ] {
        let message = message(obj, mtl);
        assert!(message.starts_with(expected), "{message}");
    }
}

/// The parts of a model, and what was noted about it.
fn noted(obj: &str, mtl: &str) -> (Vec<Part>, Vec<String>) {
    let files = Files::new(|path, _| match path.to_str() {
        Some("m.mtl") => Ok(mtl.into()),
        _ => Err(Error::reading(path, io::ErrorKind::NotFound.into())),
    });
    let parts = parse_with(Path::new("m.obj"), obj.as_bytes(), &files).unwrap();
    (parts, files.notes())
}

#[test]
fn what_can_be_drawn_without_is_noted() {
    for (obj, mtl, note) in [
        (
            "usemtl red\n",
            "",
            "m.obj:1: found no material \"red\", drawn with the default",
        ),
        (
            "mtllib m.mtl\nusemtl redd\n",
            "newmtl red\n",
            "m.obj:2: found no material \"redd\" (did you mean \"red\"?), drawn with the default",
        ),
        (
            "mtllib n.mtl\n",
            "",
            "m.obj:1: found no file \"n.mtl\", drawn without its materials",
        ),
        (
            "mtllib m.mtl\nusemtl red\n",
            "newmtl red\nmap_Kd C:\\models\\wood.png\n",
            "m.mtl:2: found no file \"C:\\\\models\\\\wood.png\", drawn without it",
        ),
        (
            "mtllib m.mtl\n",
            "newmtl red\nmap_Kd -s 1 1 1 wood.TGA\n",
            "m.mtl:2: found no PNG or JPEG but \"wood.TGA\", drawn without it",
        ),
    ] {
        let (parts, notes) = noted(&format!("{obj}{TRIANGLE}f 1 2 3\n"), mtl);
        assert_eq!(notes, [note]);
        assert_eq!(parts.len(), 1);
    }
}

#[test]
fn models_are_taken_as_they_are_found() {
    // Windows line ends, a byte order mark, comments, lines that go on, faces before their vertices, spaces in names.
    let obj = "\u{feff}# made by hand\r\nmtllib none.mtl m.mtl\r\nf 1 2 \\\r\n3\r\nusemtl dark red\r\n\
               f 1/1 2 3 # the same\r\nusemtl grey\r\nfo -0003 +2 3\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\n\
               v 0 1 0\r\nvt 0.5\r\nusemtl dark red\r\nf -3 -2 -1\r\ns off\r\nl 1 2\r\n";
    let mtl = "Kd 1 1 1\nnewmtl dark red\r\n\tKd 0.5 0 0\r\nNs -1\r\nnewmtl grey\nKd 0.3\n";
    let broken = obj.replace("fo -0003", "fo 1");
    let (parts, notes) = noted(&broken, mtl);
    assert_eq!(
        notes,
        ["m.obj:2: found no file \"none.mtl\", drawn without its materials"]
    );
    let found: Vec<_> = parts
        .iter()
        .map(|part| {
            let diffuse = part.material.as_ref().map(|material| material.diffuse.x);
            (part.mesh.faces.len(), diffuse)
        })
        .collect();
    assert_eq!(found, [(1, None), (2, Some(0.5)), (1, Some(0.3))]);
    assert_eq!(parts[1].mesh.texture_coords[0], DVec2::new(0.5, 0.0));
    // From the back, an index counts what stands above it.
    let message = message(obj, mtl);
    assert!(
        message.starts_with("m.obj:8: found the index \"-0003\""),
        "{message}"
    );
}

#[test]
fn a_normal_without_direction_is_made_up() {
    let obj = format!("{TRIANGLE}vn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3\nf 1 1 1\n");
    let mesh = &noted(&obj, "").0[0].mesh;
    assert_eq!(mesh.normals[..3], [DVec3::Z, DVec3::X, DVec3::Z]);
    assert!(mesh.normals.iter().all(|normal| normal.is_normalized()));
}

/// Some programs give every face a name of its own.
#[test]
fn a_model_of_many_names_has_few_parts() {
    let names = (0..10_000).map(|n| format!("g face{n}\nf 1 2 3\n"));
    let obj = format!("{TRIANGLE}{}", names.collect::<String>());
    let (parts, _) = noted(&obj, "");
    assert_eq!(parts.len(), 4096);
    assert_eq!(
        parts
            .iter()
            .map(|part| part.mesh.faces.len())
            .sum::<usize>(),
        10_000
    );
}

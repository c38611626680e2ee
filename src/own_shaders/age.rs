//! GLSL of the handouts' age: it is taken where the driver takes it, and told what version 330 has in its place, and why.

use super::Finding;
use super::files::File;
use crate::glsl::Scan;

/// The version of the labs' own shaders, that of OpenGL 3.3.
const VERSION: u32 = 330;

/// Words that are gone from version 330 core: what stands in their place, and why.
const GONE: [(&str, &str, &str); 14] = [
    (
        "attribute",
        "in",
        "since 130 every stage has its in and out",
    ),
    (
        "varying",
        "out in the vertex shader, in in the fragment shader",
        "since 130 every stage has its in and out",
    ),
    (
        "texture2D",
        "texture",
        "since 130 one function reads every kind of sampler",
    ),
    (
        "textureCube",
        "texture",
        "since 130 one function reads every kind of sampler",
    ),
    (
        "texture2DProj",
        "textureProj",
        "since 130 one function reads every kind of sampler",
    ),
    (
        "shadow2D",
        "texture",
        "since 130 one function reads every kind of sampler, and a comparison is a float",
    ),
    (
        "shadow2DProj",
        "textureProj",
        "since 130 one function reads every kind of sampler, and a comparison is a float",
    ),
    (
        "gl_FragColor",
        "an out vec4 of one's own",
        "a core profile has no fixed outputs",
    ),
    (
        "gl_Vertex",
        "an in of one's own",
        "a core profile has no fixed vertex attributes",
    ),
    (
        "gl_Normal",
        "an in of one's own",
        "a core profile has no fixed vertex attributes",
    ),
    (
        "gl_MultiTexCoord0",
        "an in of one's own",
        "a core profile has no fixed vertex attributes",
    ),
    (
        "gl_ModelViewMatrix",
        "a uniform of one's own",
        "a core profile has no matrix stack",
    ),
    (
        "gl_ModelViewProjectionMatrix",
        "a uniform of one's own",
        "a core profile has no matrix stack",
    ),
    (
        "ftransform",
        "the product of one's own matrices",
        "a core profile has no matrix stack",
    ),
];

pub fn check(file: &File, findings: &mut Vec<Finding>) {
    if file.text.starts_with('\u{feff}') {
        let text = "begins with a byte order mark, expected none (\"UTF-8 without signature\"): drivers refuse it";
        findings.push(Finding::note((&file.path, Some(1)), text));
        return;
    }
    let scan = Scan::new(&file.text);
    match scan.version {
        None => findings.push(Finding::note(
            (&file.path, Some(1)),
            "no #version, and so version 110, expected #version 330 core in the first line: it is the version of OpenGL 3.3",
        )),
        Some(version) if version.number < VERSION || version.profile == "es" => {
            let found = format!("{} {}", version.number, version.profile);
            let text = format!(
                "#version {}, expected #version 330 core: a core profile need not take another",
                found.trim()
            );
            findings.push(Finding::note((&file.path, Some(version.line)), text));
        }
        Some(_) => {}
    }
    for (word, instead, why) in GONE {
        if let Some(line) = scan.line_of(word) {
            let text = format!("{word}, expected {instead}: {why}");
            findings.push(Finding::note((&file.path, Some(line)), text));
        }
    }
}

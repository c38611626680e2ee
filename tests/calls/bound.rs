//! What is bound at each call, and which calls work on what is bound.

use std::collections::BTreeMap;

use super::Line;

/// What is bound: by function and target, for textures by unit too.
#[derive(Clone)]
pub struct Bound {
    unit: String,
    objects: BTreeMap<(String, String, String), String>,
}

impl Bound {
    fn key(&self, bind: &str, target: &str) -> (String, String, String) {
        let unit = if bind == "glBindTexture" {
            self.unit.as_str()
        } else {
            ""
        };
        (bind.to_owned(), target.to_owned(), unit.to_owned())
    }

    pub fn get(&self, bind: &str, target: &str) -> Option<&str> {
        self.objects
            .get(&self.key(bind, target))
            .map(String::as_str)
    }

    fn after(&mut self, line: &Line) {
        let Some(last) = line.args.last() else { return };
        if line.name == "glActiveTexture" {
            self.unit = last.clone();
        }
        if line.name == "glUseProgram" || line.name.starts_with("glBind") {
            let target = bind_target(line).unwrap_or_default();
            let targets = match target {
                "GL_FRAMEBUFFER" => vec!["GL_DRAW_FRAMEBUFFER", "GL_READ_FRAMEBUFFER"],
                target => vec![target],
            };
            for target in targets {
                self.objects
                    .insert(self.key(&line.name, target), last.clone());
            }
        }
    }
}

/// What is bound when each of the lines is called.
pub fn at_each(lines: &[Line]) -> Vec<Bound> {
    let mut bound = Bound {
        unit: "GL_TEXTURE0".to_owned(),
        objects: BTreeMap::new(),
    };
    lines
        .iter()
        .map(|line| {
            let before = bound.clone();
            bound.after(line);
            before
        })
        .collect()
}

/// The target of a call that binds; a program has none.
pub fn bind_target(line: &Line) -> Option<&str> {
    match line.args.as_slice() {
        [target, ..] if line.name != "glUseProgram" => Some(target),
        _ => None,
    }
}

pub fn same_target(bound: &str, used: &str) -> bool {
    bound == used || bound == "GL_FRAMEBUFFER" && used.ends_with("_FRAMEBUFFER")
}

/// The function that binds what a call works on, and the target at which it is bound.
pub fn works_on(line: &Line) -> Option<(&'static str, &str)> {
    let name = line.name.as_str();
    let target = line.args.first().map_or("", String::as_str);
    let starts = |beginnings: &[&str]| {
        beginnings
            .iter()
            .any(|beginning| name.starts_with(beginning))
    };
    if starts(&["glTex", "glCopyTex", "glGetTex", "glGenerateMipmap"]) {
        // The faces of a cube map are bound together.
        let cube = target.starts_with("GL_TEXTURE_CUBE_MAP_");
        Some((
            "glBindTexture",
            if cube { "GL_TEXTURE_CUBE_MAP" } else { target },
        ))
    } else if starts(&["glFramebuffer", "glCheckFramebuffer"]) && target == "GL_READ_FRAMEBUFFER"
        || starts(&["glReadBuffer", "glReadPixels"])
    {
        Some(("glBindFramebuffer", "GL_READ_FRAMEBUFFER"))
    } else if starts(&[
        "glFramebuffer",
        "glCheckFramebuffer",
        "glDraw",
        "glClearBuffer",
    ]) || name == "glClear"
    {
        Some(("glBindFramebuffer", "GL_DRAW_FRAMEBUFFER"))
    } else if starts(&["glRenderbufferStorage"]) {
        Some(("glBindRenderbuffer", target))
    } else if starts(&["glBufferData", "glBufferSubData", "glGetBuffer"]) {
        Some(("glBindBuffer", target))
    } else if name.starts_with("glUniform") && name != "glUniformBlockBinding" {
        Some(("glUseProgram", ""))
    } else {
        None
    }
}

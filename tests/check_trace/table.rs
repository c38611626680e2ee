//! Each dump, the step that its mistake breaks, and the line that is told.

use std::collections::BTreeSet;

use shadowlab::calls::Mark::{self, Missing, OtherArguments, OutOfOrder, Unclear, Wrong};

use super::{assert_clean, check, dump, folder, lab_of};

/// Programs as they stand, and how many steps are found at least.
const RIGHT: &[(&str, usize)] = &[
    ("legacy", 18),
    ("core33", 20),
    ("dsa45", 17),
    ("planar", 9),
    ("planar-fbo", 10),
];

struct Row {
    dump: &'static str,
    /// A part of what the step asks for.
    asked: &'static str,
    mark: Mark,
    /// Its name in `shadowlab mistakes`; none for what is in no course's list.
    mistake: Option<&'static str>,
    /// A part of the line of the dump that is told; empty where none is.
    line: &'static str,
}

const fn row(
    dump: &'static str,
    asked: &'static str,
    mark: Mark,
    mistake: Option<&'static str>,
    line: &'static str,
) -> Row {
    Row {
        dump,
        asked,
        mark,
        mistake,
        line,
    }
}

#[rustfmt::skip]
const WRONG: &[Row] = &[
    row("legacy-bias_matrix_missing", "B · projection", Missing, Some("bias_matrix_missing"), "glTranslated"),
    row("legacy-bias_matrix_swapped", "B · projection", OtherArguments, Some("bias_matrix_swapped"), "glTranslated"),
    row("legacy-bias_matrix_twice", "B · projection", OtherArguments, Some("bias_matrix_twice"), "glTranslated"),
    row("legacy-compare_mode", "GL_TEXTURE_COMPARE_MODE", Wrong, Some("compare_mode"), "GL_TEXTURE_COMPARE_MODE"),
    row("legacy-depth_mask", "glClear(GL_DEPTH", Wrong, Some("map_not_cleared"), "glClear(mask = GL_DEPTH_BUFFER_BIT)"),
    row("legacy-framebuffer_not_restored", "glBindFramebuffer(GL_FRAMEBUFFER, 0)", Missing, None, "glBindFramebufferEXT("),
    row("legacy-map_not_bound", "the depth texture on the unit", Missing, None, ""),
    row("legacy-map_not_cleared", "glClear(GL_DEPTH", Missing, Some("map_not_cleared"), "glEnd()"),
    row("legacy-mipmap_filter", "GL_TEXTURE_MIN_FILTER", Missing, Some("mipmap_filter"), "glTexImage2D("),
    row("legacy-misspelt_uniform", "every uniform goes", OtherArguments, Some("misspelt_uniform"), "location = -1"),
    row("legacy-model_matrix_differs", "the same model matrix", OtherArguments, Some("model_matrix_differs"), "glDrawElements("),
    row("legacy-near_too_small", "the light's matrices", Unclear, Some("near_too_small"), "glTranslated"),
    row("legacy-no_draw_buffer_none", "glDrawBuffer(GL_NONE)", Missing, Some("no_draw_buffer_none"), "glFramebufferTexture2DEXT"),
    row("legacy-other_program", "every uniform goes", OutOfOrder, Some("same_texture_unit"), "glUniform1i(location = 1, v0 = 1)"),
    row("legacy-repeat_outside", "a wrap mode", Missing, Some("repeat_outside"), ""),
    row("legacy-same_texture_unit", "a texture unit of its own", Wrong, Some("same_texture_unit"), "glUniform1i("),
    row("legacy-viewport_not_restored", "with the window's size", Missing, Some("viewport_not_restored"), "width = 512"),
    row("legacy-viewport_not_set", "with the map's size", Missing, Some("viewport_not_set"), "width = 300"),

    row("core33-attached_as_color", "a framebuffer object with a depth texture", OtherArguments, None, "GL_COLOR_ATTACHMENT0"),
    row("core33-bias_matrix_missing", "B · projection", Missing, Some("bias_matrix_missing"), "glUniformMatrix4fv"),
    row("core33-clear_before_bind", "glClear(GL_DEPTH", OutOfOrder, Some("map_not_cleared"), "glClear("),
    row("core33-cleared_to_zero", "glClear(GL_DEPTH", OtherArguments, Some("map_not_cleared"), "glClear("),
    row("core33-compare_mode", "GL_TEXTURE_COMPARE_MODE", Missing, Some("compare_mode"), ""),
    row("core33-culling_not_reset", "glCullFace(GL_BACK)", Missing, None, "glCullFace(mode = GL_FRONT)"),
    row("core33-degrees_for_radians", "the light's matrices", Unclear, Some("degrees_for_radians"), "glUniformMatrix4fv"),
    row("core33-depth_not_cleared", "glClear(GL_COLOR", Missing, None, "glBindFramebuffer("),
    row("core33-depth_test_off", "the depth test", Wrong, None, "glDisable(cap = GL_DEPTH_TEST)"),
    row("core33-light_along_up", "the light's matrices", Wrong, Some("light_along_up"), "nan"),
    row("core33-map_overwritten", "the depth texture on the unit", Missing, None, "glBindTexture("),
    row("core33-misspelt_uniform", "every uniform goes", OtherArguments, Some("misspelt_uniform"), "location = -1"),
    row("core33-model_matrix_differs", "the same model matrix", OtherArguments, Some("model_matrix_differs"), "glDrawArrays("),
    row("core33-no_bias", "a bias", OtherArguments, Some("no_bias"), "v0 = 0)"),
    row("core33-no_draw_buffer_none", "glDrawBuffer(GL_NONE)", OtherArguments, Some("no_draw_buffer_none"), "glDrawBuffer("),
    row("core33-no_swizzle", "GL_TEXTURE_SWIZZLE_RGBA", Missing, Some("no_swizzle"), "glTexImage2D("),
    row("core33-row_major", "B · projection", OtherArguments, Some("row_major"), "glUniformMatrix4fv"),
    row("core33-same_texture_unit", "a texture unit of its own", Wrong, Some("same_texture_unit"), "glUniform1i("),
    row("core33-sampler_as_float", "every uniform goes", OtherArguments, None, "glUniform1f("),
    row("core33-uniform_before_program", "every uniform goes", OutOfOrder, None, "glUniformMatrix4fv"),

    row("dsa45-bias_matrix_missing", "B · projection", Missing, Some("bias_matrix_missing"), "glProgramUniformMatrix4fv"),
    row("dsa45-bias_matrix_swapped", "B · projection", OtherArguments, Some("bias_matrix_swapped"), "glProgramUniformMatrix4fv"),
    row("dsa45-bias_matrix_twice", "B · projection", OtherArguments, Some("bias_matrix_twice"), "glProgramUniformMatrix4fv"),
    row("dsa45-cleared_late", "glClear(GL_DEPTH", OutOfOrder, Some("map_not_cleared"), "glClearNamedFramebufferfv"),
    row("dsa45-compare_mode", "GL_TEXTURE_COMPARE_MODE", Missing, Some("compare_mode"), ""),
    row("dsa45-framebuffer_not_restored", "glBindFramebuffer(GL_FRAMEBUFFER, 0)", Missing, None, "glBindFramebuffer("),
    row("dsa45-map_not_bound", "the depth texture on the unit", Missing, None, ""),
    row("dsa45-map_not_cleared", "glClear(GL_DEPTH", Missing, Some("map_not_cleared"), "glDrawArrays("),
    row("dsa45-no_draw_buffer_none", "glDrawBuffer(GL_NONE)", Missing, Some("no_draw_buffer_none"), "glNamedFramebufferTexture"),
    row("dsa45-repeat_outside", "a wrap mode", Missing, Some("repeat_outside"), ""),
    row("dsa45-row_major", "B · projection", OtherArguments, Some("row_major"), "GL_TRUE"),
    row("dsa45-same_texture_unit", "a texture unit of its own", Wrong, Some("same_texture_unit"), ""),
    row("dsa45-unchecked", "glCheckFramebufferStatus", Missing, None, ""),
    row("dsa45-viewport_not_restored", "with the window's size", Missing, Some("viewport_not_restored"), "width = 400"),
    row("dsa45-viewport_not_set", "with the map's size", OtherArguments, Some("viewport_not_set"), "width = 200"),

    row("planar-accumulator_not_cleared", "the accumulation buffer is cleared", Missing, Some("accumulator_not_cleared"), "glAccum("),
    row("planar-accumulator_of_8_bits", "more than 8 bits", OtherArguments, None, "GL_RGBA8"),
    row("planar-fbo-accumulator_not_cleared", "the accumulator is cleared", Missing, Some("accumulator_not_cleared"), "glEnd()"),
    row("planar-fbo-not_returned", "fbo_accum_return", Missing, None, "glEnd()"),
    row("planar-fbo-weights_wrong", "fbo_accum: blended", OtherArguments, Some("weights_wrong"), "glBlendColor("),
    row("planar-no_polygon_offset", "glPolygonOffset", Missing, Some("no_polygon_offset"), "glDraw"),
    row("planar-not_returned", "glAccum(GL_RETURN", Missing, None, "glAccum("),
    row("planar-plane_sign", "multShadowMat", OtherArguments, Some("plane_sign"), "glMultMatrixf"),
    row("planar-polygon_offset_away", "glPolygonOffset", OtherArguments, Some("no_polygon_offset"), "glPolygonOffset(factor = 1"),
    row("planar-shadow_matrix_row_major", "multShadowMat", OtherArguments, Some("shadow_matrix_row_major"), "glMultMatrixf"),
    row("planar-stencil_always", "where the stencil is 1", OtherArguments, None, "glStencilFunc(func = GL_ALWAYS"),
    row("planar-stencil_kept", "the stencil is set", OtherArguments, None, "glStencilOp("),
    row("planar-stencil_not_cleared", "the stencil buffer is cleared", Missing, None, ""),
    row("planar-sum_then_divide", "glAccum(GL_ACCUM", OtherArguments, None, "glAccum("),
    row("planar-weights_wrong", "glAccum(GL_ACCUM", OtherArguments, Some("weights_wrong"), "glAccum("),
];

#[test]
fn right_programs_are_clean() {
    for (name, found) in RIGHT {
        let report = check(&dump(name), lab_of(name));
        assert_clean(&report, *found, name);
        assert_eq!(report.frames, 2, "{name}");
    }
}

#[test]
fn every_mistake_is_told_at_its_step_and_line() {
    for row in WRONG {
        let text = dump(row.dump);
        let report = check(&text, lab_of(row.dump));
        let told = report.text();
        let mut steps = report.steps.iter();
        let step = steps
            .find(|step| step.asked.contains(row.asked) && step.mark == row.mark)
            .unwrap_or_else(|| panic!("{}: {}: {told}", row.dump, row.asked));
        assert_eq!(step.mistake, row.mistake, "{}: {told}", row.dump);
        assert!(
            !step.effect.is_empty() && !step.fix.is_empty(),
            "{}: {told}",
            row.dump
        );
        let line = step
            .line
            .map(|line| text.lines().nth(line as usize - 1).unwrap());
        match (row.line, line) {
            ("", None) => {}
            (part, Some(line)) if !part.is_empty() => {
                assert!(line.contains(part), "{}: {line} is told: {told}", row.dump);
            }
            (part, line) => panic!("{}: {line:?} is told, and not {part}: {told}", row.dump),
        }
        // What is a matter of judgement is told and no failure.
        assert_eq!(
            report.is_clean(),
            row.mark == Unclear,
            "{}: {told}",
            row.dump
        );
    }
}

/// A mistake brings no other with it that is not there: at most the steps that follow from it.
#[test]
fn few_other_steps_are_told() {
    for row in WRONG {
        let report = check(&dump(row.dump), lab_of(row.dump));
        let wrong = super::wrong(&report);
        let other: Vec<_> = wrong
            .iter()
            .filter(|step| step.mistake.is_none() || step.mistake != row.mistake)
            .filter(|step| !step.asked.contains(row.asked))
            .map(|step| (row.dump, step.asked))
            .collect();
        let follows: &[_] = match row.dump {
            // The unit of a sampler that could not be set is 0, and so is that of the other.
            "core33-sampler_as_float" => &[
                "the depth texture on the unit of its sampler",
                "a texture unit of its own for each sampler",
            ],
            // A matrix that could not be set is all zeros.
            "core33-uniform_before_program" => &["every matrix of the program is set"],
            _ => &[],
        };
        let mut told: Vec<_> = other.iter().map(|(_, asked)| *asked).collect();
        let mut follows = follows.to_vec();
        told.sort_unstable();
        follows.sort_unstable();
        assert_eq!(told, follows, "{}: {}", row.dump, report.text());
    }
}

/// No dump without its row, and no MISTAKE_ without its dump.
#[test]
fn every_dump_is_in_the_table() {
    let known: BTreeSet<String> = RIGHT
        .iter()
        .map(|(name, _)| (*name).to_owned())
        .chain(WRONG.iter().map(|row| row.dump.to_owned()))
        .collect();
    let mut there = BTreeSet::new();
    let mut made = BTreeSet::new();
    for entry in std::fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("txt") => {
                there.insert(stem);
            }
            Some("cpp") => {
                let source = std::fs::read_to_string(&path).unwrap();
                for rest in source.split("MISTAKE_").skip(1) {
                    let name: String = rest
                        .chars()
                        .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
                        .collect();
                    if !name.is_empty() {
                        made.insert(format!("{stem}-{name}"));
                    }
                }
            }
            _ => {}
        }
    }
    assert_eq!(there, known);
    assert!(made.is_subset(&there), "{:?}", made.difference(&there));
    assert!(made.len() > 50, "{}", made.len());
}

//! The plane whose false shadow is known in closed form, as it is drawn and as it is told.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::Result;
use crate::gl;
use crate::hard::anchor::{self, ANGLES, BIASES, LAB, MAP_SIZES};
use crate::headless::{Choice, Headless};
use crate::labs::{self, Show};
use crate::progress::Progress;
use crate::report::bench;

/// One angle, map and bias.
#[derive(Clone, Copy, Debug)]
pub struct AnchorRow {
    pub degrees: f64,
    pub map_size: u32,
    /// In units of the least bias that is enough.
    pub bias: f64,
    pub bias_texels: f64,
    /// Shares of the plane in false shadow.
    pub measured: f64,
    pub told: f64,
}

/// As many as there are rows.
pub const STEPS: u64 = (ANGLES.len() * MAP_SIZES.len() * BIASES.len()) as u64;

/// All rows, or none where `stop` was raised before the last.
pub fn measure(
    device: &Choice,
    size: [u32; 2],
    progress: &Progress,
    stop: &AtomicBool,
) -> Result<Vec<AnchorRow>> {
    let handout = labs::find(LAB)?;
    let mut rows = Vec::new();
    for degrees in ANGLES {
        let context = Headless::open(device, size, false)?;
        let mut lab = bench::start(handout, &context, anchor::tilted(degrees), size)?;
        for map_size in MAP_SIZES {
            let texel = anchor::texel(map_size);
            for bias in BIASES {
                if stop.load(Ordering::Relaxed) {
                    return Ok(Vec::new());
                }
                let length = bias * anchor::deepest(texel, degrees);
                let depth = anchor::in_depth(length);
                lab.settings().set(&format!("map_size={map_size}"))?;
                lab.settings().set(&format!("bias={depth}"))?;
                lab.render(&context.gl, Show::Visibility { light: 1 })?;
                gl::check_errors(&context.gl, "drawing")?;
                let visibility = gl::read_grey(&context.gl, size);
                let dark = visibility.pixels().filter(|pixel| pixel.0[0] == 0).count();
                rows.push(AnchorRow {
                    degrees,
                    map_size,
                    bias,
                    bias_texels: length / texel,
                    measured: dark as f64 / visibility.len() as f64,
                    told: anchor::false_shadow(texel, degrees, length),
                });
                progress.add(1);
            }
        }
    }
    Ok(rows)
}

/// The largest difference between what was measured and what is told.
pub fn worst(rows: &[AnchorRow]) -> f64 {
    let differences = rows.iter().map(|row| (row.measured - row.told).abs());
    differences.fold(0.0, f64::max)
}

//! `[camera]`.

use glam::DVec3;

use super::numbers::Kind;
use super::table::{Either, SHORTEST, Table};
use crate::Result;
use crate::scene::{Camera, Fov};

pub const KEYS: &[&str] = &["eye", "target", "look", "up", "fovy", "fovx", "near", "far"];

pub fn camera(table: &Table) -> Result<Camera> {
    let eye = table.required("eye")?.vector(Kind::Any)?;
    let look = match table.either("target", "look")? {
        None => {
            let message = "found no target and no look in [camera], expected one of the two";
            return Err(table.wrong(message.to_owned()));
        }
        Some(Either::One(target)) => {
            let look = target.vector(Kind::Any)? - eye;
            if look.length() < SHORTEST {
                return Err(target.wrong("a target away from the eye"));
            }
            look
        }
        Some(Either::Other(look)) => look.direction()?,
    };
    let up = table.value("up");
    let rup = up.as_ref().map_or(Ok(DVec3::Y), |up| up.direction())?;
    if rup.normalize().cross(look.normalize()).length() < SHORTEST {
        let message = "found up along the look, expected it to be across";
        return Err(match up {
            Some(up) => up.error(message.to_owned()),
            None => table.wrong(message.to_owned()),
        });
    }
    let fov = match table.either("fovy", "fovx")? {
        None => Fov::Vertical(45.0),
        Some(Either::One(fovy)) => Fov::Vertical(fovy.number(Kind::View)?),
        Some(Either::Other(fovx)) => Fov::Horizontal(fovx.number(Kind::View)?),
    };
    let near = table.number("near", Kind::Length, 0.1)?;
    let far = match table.value("far") {
        None => None,
        Some(value) => {
            let far = value.number(Kind::Length)?;
            if far <= near {
                return Err(value.wrong(&format!("more than near, which is {near}")));
            }
            Some(far)
        }
    };
    Ok(Camera {
        eye,
        look,
        rup,
        fov,
        near,
        far,
    })
}

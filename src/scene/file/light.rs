//! `[light]`.

use glam::DVec3;

use super::numbers::Kind;
use super::table::{Either, SHORTEST, Table, Value};
use crate::Result;
use crate::scene::camera::{up_for, view};
use crate::scene::{Beam, Light, LightKind, Object};

pub const KEYS: &[&str] = &[
    "kind",
    "position",
    "target",
    "direction",
    "cone",
    "beam",
    "color",
    "near",
    "far",
    "shadow_fov",
    "box",
];

pub fn light(table: &Table, objects: &[Object]) -> Result<Light> {
    // Every key is read, whatever the kind: what is written must make sense.
    let kind = table.choice("kind", &["spot", "point", "directional"])?;
    let cone = table.number("cone", Kind::View, 60.0)?;
    let beam = match table.choice("beam", &["circular", "rectangular"])? {
        "circular" => Beam::Circular,
        _ => Beam::Rectangular,
    };
    let shadow_fov = table.number("shadow_fov", Kind::View, 120.0)?;
    let color = table.vector("color", Kind::Color, DVec3::ONE)?;
    let near = table.number("near", Kind::Length, 1.0)?;
    let far = far(table, near)?;
    let position = table.value("position");
    let position = position.map(|value| value.vector(Kind::Any)).transpose()?;
    let area = table.value("box").map(|value| area(&value)).transpose()?;
    let light = Light {
        kind: match kind {
            "spot" => LightKind::Spot { cone, beam },
            _ => LightKind::Point { shadow_fov },
        },
        position: position.unwrap_or_default(),
        direction: direction(table, kind, position)?,
        color,
        near,
        far,
    };
    match (kind, position) {
        ("directional", _) => Ok(directional(light, position, area, objects)),
        (_, Some(_)) => Ok(light),
        (_, None) => table.required("position").map(|_| light),
    }
}

fn far(table: &Table, near: f64) -> Result<f64> {
    let far = table.number("far", Kind::Length, 30.0)?;
    if far > near {
        return Ok(far);
    }
    let expected = format!("more than near, which is {near}");
    Err(match table.value("far") {
        Some(value) => value.wrong(&expected),
        None => table.wrong(format!(
            "found far = {far}, its default, expected {expected}"
        )),
    })
}

/// The way the light travels.
fn direction(table: &Table, kind: &str, position: Option<DVec3>) -> Result<DVec3> {
    match (table.either("target", "direction")?, position) {
        (Some(Either::Other(direction)), _) => direction.direction(),
        (Some(Either::One(target)), Some(position)) => {
            let direction = target.vector(Kind::Any)? - position;
            if direction.length() < SHORTEST {
                return Err(target.wrong("a target away from the light's position"));
            }
            Ok(direction)
        }
        (None, Some(position)) if kind != "directional" => {
            if position.length() < SHORTEST {
                let message = "found position = [0, 0, 0] and no target, whose default that is, expected another target or a direction";
                return Err(table.wrong(message.to_owned()));
            }
            Ok(-position)
        }
        (_, None) if kind != "directional" => Err(table
            .required("position")
            .err()
            .expect("there is no position")),
        _ => Err(table.wrong(
            "found no direction in [light], expected one, or a position and a target".to_owned(),
        )),
    }
}

/// Left, right, bottom, top, near and far.
fn area(value: &Value) -> Result<[f64; 6]> {
    let area: [f64; 6] = value.numbers(Kind::Any)?;
    let [left, right, bottom, top, near, far] = area;
    if left < right && bottom < top && near < far {
        Ok(area)
    } else {
        Err(value.wrong("left < right, bottom < top, near < far"))
    }
}

/// The box as it is given, or the smallest one with the whole scene in it.
fn directional(
    light: Light,
    position: Option<DVec3>,
    area: Option<[f64; 6]>,
    objects: &[Object],
) -> Light {
    let direction = light.direction.normalize();
    let view = view(DVec3::ZERO, direction, up_for(direction));
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    for point in objects.iter().flat_map(reached) {
        let seen = view.transform_point3(point);
        (low, high) = (low.min(seen), high.max(seen));
    }
    // A margin, so that nothing lies on the edge, and a flat scene has a box as well.
    let margin = (0.01 * (high - low).max_element()).max(SHORTEST);
    // By default it stands in the middle of the box's front.
    let front = ((low + high) / 2.0).with_z(high.z + margin);
    let position = position.unwrap_or_else(|| view.inverse().transform_point3(front));
    let origin = view.transform_point3(position);
    let (low, high) = (low - margin - origin, high + margin - origin);
    let fitted = [low.x, high.x, low.y, high.y, -high.z, -low.z];
    let [left, right, bottom, top, near, far] = area.unwrap_or(fitted);
    Light {
        kind: LightKind::Directional {
            area: [left, right, bottom, top],
        },
        position,
        near,
        far,
        ..light
    }
}

/// Points whose box holds the object at any time: its vertices, or the corners of what it sweeps as it spins.
fn reached(object: &Object) -> Vec<DVec3> {
    let placed = |point: DVec3| object.placement.transform_point3(point);
    let positions = &object.mesh.positions;
    if object.spin.is_none() {
        return positions.iter().copied().map(placed).collect();
    }
    let radius = positions.iter().map(|p| p.length()).fold(0.0, f64::max);
    let sides = [-radius, radius];
    let corners = sides.into_iter().flat_map(|x| {
        sides
            .into_iter()
            .flat_map(move |y| sides.map(move |z| DVec3::new(x, y, z)))
    });
    corners.map(placed).collect()
}

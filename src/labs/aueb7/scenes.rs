//! The course's three scenes, each as its scene graph.

use std::path::Path;
use std::sync::Arc;

use glam::{DMat4, DVec3, dvec3};
use image::RgbaImage;

use crate::scene::graph::{Node, TransformNode};
use crate::scene::{
    Beam, Camera, Fov, Light, LightKind, Material, Object, Scene, obj, rotate, shapes,
};
use crate::{Error, Result};

/// A file of the course, in the program.
type File = (&'static str, &'static [u8]);

macro_rules! file {
    ($name:literal) => {
        (
            $name,
            include_bytes!(concat!("../../../assets/aueb7/", $name)),
        )
    };
}

const BALL_01: File = file!("ball_01.png");
const BALL_02: File = file!("ball_02.png");
const TERRAIN: &[File] = &[
    file!("terrain.obj"),
    file!("terrain.mtl"),
    file!("sand.png"),
];
const SKELETON: &[File] = &[
    file!("skeleton.obj"),
    file!("skeleton.mtl"),
    file!("bone.png"),
];
const TREASURE: &[File] = &[
    file!("treasure.obj"),
    file!("treasure.mtl"),
    file!("wood.png"),
    file!("gold.png"),
];
const PALACE: &[File] = &[
    file!("palace.obj"),
    file!("palace.mtl"),
    file!("wall.png"),
    file!("fresco.png"),
    file!("paving.png"),
];

/// A scene whose objects hang in a graph.
pub struct SceneGraph {
    /// Camera, light and colors; no objects.
    pub surroundings: Scene,
    pub root: TransformNode,
}

impl SceneGraph {
    /// The eye and the light look at the origin; everything else is the same in all three scenes.
    fn new(eye: DVec3, light: DVec3) -> Self {
        Self {
            surroundings: Scene {
                size: None,
                clear: dvec3(0.03, 0.2, 0.22),
                camera: Camera {
                    eye,
                    look: -eye,
                    rup: DVec3::Y,
                    fov: Fov::Vertical(30.0),
                    near: 1.0,
                    far: Some(1000.0),
                },
                lights: vec![Light {
                    kind: LightKind::Spot {
                        cone: 90.0,
                        beam: Beam::Rectangular,
                    },
                    position: light,
                    direction: -light,
                    color: dvec3(1.0, 0.57, 0.16),
                    near: 1.0,
                    far: 100.0,
                }],
                ambient: dvec3(0.02, 0.1, 0.15),
                sky: None,
                objects: Vec::new(),
            },
            root: TransformNode::group(),
        }
    }

    /// A scene of which no more is known than where each object is.
    pub fn of(mut scene: Scene) -> Self {
        let mut root = TransformNode::group();
        for mut object in std::mem::take(&mut scene.objects) {
            // A mirror turns triangles over, and culling would show the far side of the object.
            if object.placement.determinant() < 0.0 {
                let mesh = Arc::make_mut(&mut object.mesh);
                mesh.faces.iter_mut().for_each(|face| face.swap(1, 2));
            }
            root.add_child(Node::Geometry(object));
        }
        Self {
            surroundings: scene,
            root,
        }
    }

    /// The scene as rays see it, with what lies above the graph's root.
    pub fn flattened(&self, above: DMat4, time: f64) -> Scene {
        let geometry = self.root.geometry(above, time);
        let placed = |(object, placement): (&Object, DMat4)| Object {
            placement,
            spin: None,
            ..object.clone()
        };
        Scene {
            objects: geometry.into_iter().map(placed).collect(),
            ..self.surroundings.clone()
        }
    }

    fn add(&mut self, mut node: TransformNode, objects: Vec<Object>) {
        for object in objects {
            node.add_child(Node::Geometry(object));
        }
        self.root.add_child(Node::Transform(node));
    }
}

/// A plane and two spheres.
#[doc(alias = "SceneGraphExampleInit")]
pub fn scene_graph_example_init() -> Result<SceneGraph> {
    let mut graph = SceneGraph::new(dvec3(0.0, 30.0, 80.0), dvec3(5.0, 20.0, 0.0));
    // The shapes have their axes along z; here y is up.
    let upright = rotate(-90.0, DVec3::X);
    graph.add(
        TransformNode::new(dvec3(0.0, -10.0, 0.0), upright, dvec3(100.0, 100.0, 1.0)),
        vec![object("plane", shapes::plane(20), plain(GREY))],
    );
    for (name, x, ball) in [("sphere 1", -10.0, BALL_01), ("sphere 2", 10.0, BALL_02)] {
        graph.add(
            TransformNode::new(dvec3(x, 0.0, 0.0), upright, DVec3::splat(3.0)),
            vec![object(name, shapes::sphere(24), textured(ball)?)],
        );
    }
    Ok(graph)
}

/// A pirate who guards what he has buried.
#[doc(alias = "SceneGraphExample2Init")]
pub fn scene_graph_example_2_init() -> Result<SceneGraph> {
    let mut graph = SceneGraph::new(dvec3(80.0, 60.0, 100.0), dvec3(30.0, 60.0, 0.0));
    let half_turn = rotate(180.0, DVec3::Y);
    graph.add(
        TransformNode::new(dvec3(0.0, -8.0, 0.0), DMat4::IDENTITY, DVec3::splat(10.0)),
        load_obj(TERRAIN)?,
    );
    graph.add(
        TransformNode::new(dvec3(0.0, 0.0, -18.0), half_turn, DVec3::ONE),
        load_obj(SKELETON)?,
    );
    graph.add(
        TransformNode::new(dvec3(0.0, 2.0, 0.0), half_turn, DVec3::splat(0.5)),
        load_obj(TREASURE)?,
    );
    Ok(graph)
}

/// A palace in the manner of Knossos. Where it stands was chosen: low enough for the light to reach into its court, and
/// with almost all that is seen of it within the shadow map.
#[doc(alias = "SceneGraphExample3Init")]
pub fn scene_graph_example_3_init() -> Result<SceneGraph> {
    let mut graph = SceneGraph::new(dvec3(0.0, 100.0, 170.0), dvec3(60.0, 30.0, 0.0));
    graph.add(
        TransformNode::new(
            dvec3(5.0, -10.0, 4.0),
            rotate(18.0, DVec3::Y),
            DVec3::splat(1.05),
        ),
        load_obj(PALACE)?,
    );
    Ok(graph)
}

fn object(name: &str, mesh: crate::scene::Mesh, material: Material) -> Object {
    Object::new(name, mesh, DMat4::IDENTITY, material)
}

/// What the course's plane is made of: the colors that were measured of it are this grey's, which modelling programs give
/// to what has no other color.
const GREY: DVec3 = DVec3::splat(0.588);

fn plain(diffuse: DVec3) -> Material {
    Material {
        diffuse,
        ..Material::default()
    }
}

fn textured(file: File) -> Result<Material> {
    Ok(Material {
        texture: Some(load_texture(file)?),
        ..Material::default()
    })
}

/// A model, an object for each of its materials.
fn load_obj(files: &[File]) -> Result<Vec<Object>> {
    let (name, text) = files[0];
    let parts = obj::parse(Path::new(name), text, |wanted| {
        let found = files.iter().find(|(known, _)| *known == wanted);
        Ok(found.expect("the model's files are given").1.to_vec())
    })?;
    let of_part =
        |part: obj::Part| object(&part.name, part.mesh, part.material.unwrap_or_default());
    Ok(parts.into_iter().map(of_part).collect())
}

fn load_texture((name, bytes): File) -> Result<Arc<RgbaImage>> {
    let picture = image::load_from_memory(bytes);
    let picture = picture.map_err(|error| Error::input(name, None, error.to_string()))?;
    Ok(Arc::new(picture.into_rgba8()))
}

//! The course's SceneGraph, as small as its scenes are: what hangs under a node moves with it.
//!
//! Its GroupNode is a [`TransformNode`] that does nothing, its GeometryNode holds an [`Object`].

use glam::{DMat4, DVec3};

use super::Object;

#[doc(alias = "GroupNode")]
#[derive(Clone, Debug)]
pub struct TransformNode {
    /// From the space of its children to that of the node above.
    pub matrix: DMat4,
    children: Vec<Node>,
}

#[derive(Clone, Debug)]
pub enum Node {
    Transform(TransformNode),
    #[doc(alias = "GeometryNode")]
    Geometry(Object),
}

impl TransformNode {
    /// The node's matrix is T·R·S: the scale comes first, the translation last.
    pub fn new(translation: DVec3, rotation: DMat4, scale: DVec3) -> Self {
        Self {
            matrix: DMat4::from_translation(translation) * rotation * DMat4::from_scale(scale),
            children: Vec::new(),
        }
    }

    /// A node that leaves everything where it is.
    pub fn group() -> Self {
        Self::new(DVec3::ZERO, DMat4::IDENTITY, DVec3::ONE)
    }

    #[doc(alias = "AddChild")]
    pub fn add_child(&mut self, child: Node) {
        self.children.push(child);
    }

    /// The geometry under the node, in the order in which it was added, each with its matrix to world space at a time in
    /// seconds; `above` is the matrix of what the node itself hangs under.
    pub fn geometry(&self, above: DMat4, time: f64) -> Vec<(&Object, DMat4)> {
        let here = above * self.matrix;
        let mut found = Vec::new();
        for child in &self.children {
            match child {
                Node::Transform(node) => found.extend(node.geometry(here, time)),
                Node::Geometry(object) => found.push((object, here * object.model(time))),
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;
    use crate::scene::{Material, Mesh, rotate};

    fn node(object: &str) -> TransformNode {
        let (turn, scale) = (rotate(90.0, DVec3::Y), dvec3(2.0, 3.0, 4.0));
        let mut node = TransformNode::new(dvec3(10.0, 0.0, 0.0), turn, scale);
        let object = Object::new(
            object,
            Mesh::default(),
            DMat4::IDENTITY,
            Material::default(),
        );
        node.add_child(Node::Geometry(object));
        node
    }

    #[test]
    fn scale_comes_first_and_translation_last() {
        let matrix = node("").matrix;
        let found = matrix.transform_point3(dvec3(1.0, 1.0, 1.0));
        assert!(found.distance(dvec3(14.0, 3.0, -2.0)) < 1e-12, "{found}");
        // The control: any other order puts the point elsewhere.
        let [t, r, s] = [
            DMat4::from_translation(dvec3(10.0, 0.0, 0.0)),
            rotate(90.0, DVec3::Y),
            DMat4::from_scale(dvec3(2.0, 3.0, 4.0)),
        ];
        for other in [t * s * r, r * t * s, r * s * t, s * r * t, s * t * r] {
            let other = other.transform_point3(dvec3(1.0, 1.0, 1.0));
            assert!(other.distance(found) > 1.0, "{other}");
        }
    }

    #[test]
    fn what_hangs_under_a_node_moves_with_it() {
        let mut inner = node("inner");
        let mut root = TransformNode::group();
        let own = inner.matrix;
        inner.add_child(Node::Transform(node("innermost")));
        root.add_child(Node::Transform(inner));
        root.add_child(Node::Transform(node("last")));
        let above = DMat4::from_translation(dvec3(0.0, 5.0, 0.0));
        let found = root.geometry(above, 0.0);
        let names: Vec<&str> = found
            .iter()
            .map(|(object, _)| object.name.as_str())
            .collect();
        assert_eq!(names, ["inner", "innermost", "last"]);
        assert_eq!(found[0].1, above * own);
        assert_eq!(found[1].1, above * own * own);
        assert_eq!(found[2].1, above * own);
    }
}

//! The course's meshes.

//! CMSC 23700, project 3: shadow maps for one or two lights, in a box where balls bounce.
//!
//! | the handout | here |
//! |---|---|
//! | User interface: `+` adds a ball to the simulation | [`simulation::Simulation::new_ball`] |
//! | User interface: `-` removes a ball from the simulation | [`simulation::Simulation::kill_ball`] |
//!
//! Chosen, because the handout does not say it: which ball is removed (the newest), and which of the eight colours a
//! ball has (they are given in turn).

pub mod simulation;

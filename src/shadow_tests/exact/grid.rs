//! The grid of cells.
//!
//! They are filled in bands of rows, each by one thread, which alone knows its cells: the bands need no locks, and what
//! comes out does not depend on who did what.

use rayon::prelude::*;

use super::band::{Band, Cell, Content, Piece};
use super::builder::WORTH_A_THREAD;
use super::caster::Listed;
use super::node::Node;
use crate::shadow_tests::polygon::rows;

/// Bands for each thread: where casters are many in some rows and few in others, threads take turns.
const BANDS_FOR_A_THREAD: usize = 4;

/// The cells while they are filled; kept for its memory.
#[derive(Default)]
pub struct Filling {
    bands: Vec<Band>,
}

impl Filling {
    /// Fills the grid; returns how long all lists are together.
    pub fn fill(&mut self, content: Content) -> usize {
        let shapes = (0..content.shapes.len()).into_par_iter();
        let pieces = shapes
            .with_min_len(WORTH_A_THREAD)
            .fold(Vec::new, |mut pieces, index| {
                add_pieces(&mut pieces, content, index);
                pieces
            });
        let pieces: Vec<Vec<Piece>> = pieces.collect();

        let all_rows = (content.layout.faces() * content.layout.side) as usize;
        let bands = match content.shapes.len() < WORTH_A_THREAD {
            true => 1,
            false => BANDS_FOR_A_THREAD * rayon::current_num_threads(),
        };
        self.bands.resize_with(bands.min(all_rows), Band::default);
        let count = self.bands.len();
        for (i, band) in self.bands.iter_mut().enumerate() {
            band.rows = [
                (i * all_rows / count) as u32,
                ((i + 1) * all_rows / count - 1) as u32,
            ];
        }
        let bands = self.bands.par_iter_mut();
        bands.for_each(|band| band.fill(content, &pieces));
        self.bands.iter().map(|band| band.listed as usize).sum()
    }

    /// The cells, and their lists as nodes; in front of those are `first` others.
    pub fn write(
        &self,
        side: u32,
        mut cells: &mut [Cell],
        mut lists: &mut [Node],
        mut first: u32,
        casters: &[Listed],
    ) {
        let mut parts = Vec::new();
        for band in &self.bands {
            let [first_row, last_row] = band.rows;
            let of_band;
            (of_band, cells) = cells.split_at_mut(((last_row - first_row + 1) * side) as usize);
            let its_lists;
            (its_lists, lists) = lists.split_at_mut(band.listed as usize);
            parts.push((band, of_band, its_lists, first));
            first += band.listed;
        }
        let parts = parts.into_par_iter();
        parts.for_each(|(band, cells, lists, first)| band.write(cells, lists, first, casters));
    }
}

/// Adds the pieces of a shape: one where one face sees all of it.
fn add_pieces(pieces: &mut Vec<Piece>, content: Content, index: usize) {
    let Content {
        layout,
        shapes,
        points,
        seen,
        ..
    } = content;
    let shape = &shapes[index];
    let faces = match layout.face_of(shape, seen) {
        Some(face) => face..face + 1,
        None => 0..layout.faces(),
    };
    for face in faces {
        let outline = layout.outline(shape, face, points, seen);
        let corners = outline.corners();
        if !corners.is_empty() {
            pieces.push(Piece {
                shape: index as u32,
                face,
                rows: rows(corners, layout.side).map(|row| face * layout.side + row),
            });
        }
    }
}

//! The grid of cells.
//!
//! They are filled in bands of rows, each by one thread, which alone knows its cells: the bands need no locks, and what
//! comes out does not depend on who did what.

use rayon::prelude::*;

use super::band::{Band, Cell, Content, Piece};
use super::builder::WORTH_A_THREAD;
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
        let all_rows = content.layout.faces() * content.layout.side;
        let bands = match content.shapes.len() < WORTH_A_THREAD {
            true => 1,
            false => (BANDS_FOR_A_THREAD * rayon::current_num_threads()) as u32,
        };
        let count = bands.min(all_rows);
        self.bands.resize_with(count as usize, Band::default);
        for (band, i) in self.bands.iter_mut().zip(0..) {
            band.rows = [i * all_rows / count, (i + 1) * all_rows / count - 1];
        }

        // Some shapes at a time, sorted into bands.
        let bands = &self.bands;
        let shapes = (0..content.shapes.len()).into_par_iter();
        let pieces = shapes.with_min_len(WORTH_A_THREAD).fold(
            || vec![Vec::new(); bands.len()],
            |mut pieces, index| {
                add_pieces(&mut pieces, bands, content, index);
                pieces
            },
        );
        let pieces: Vec<Vec<Vec<Piece>>> = pieces.collect();
        let bands = self.bands.par_iter_mut().enumerate();
        bands.for_each(|(i, band)| band.fill(content, pieces.iter().flat_map(|pieces| &pieces[i])));
        self.bands.iter().map(|band| band.nodes as usize).sum()
    }

    /// The cells, and their lists as nodes; in front of those are `first` others.
    pub fn write(
        &mut self,
        content: Content,
        mut cells: &mut [Cell],
        mut lists: &mut [Node],
        mut first: u32,
    ) {
        let mut parts = Vec::new();
        for band in &mut self.bands {
            let [first_row, last_row] = band.rows;
            let count = (last_row - first_row + 1) * content.layout.side;
            let of_band;
            (of_band, cells) = cells.split_at_mut(count as usize);
            let nodes = band.nodes;
            let its_lists;
            (its_lists, lists) = lists.split_at_mut(nodes as usize);
            parts.push((band, of_band, its_lists, first));
            first += nodes;
        }
        let parts = parts.into_par_iter();
        parts.for_each(|(band, cells, lists, first)| band.write(content, cells, lists, first));
    }
}

/// Adds the pieces of a shape to those of the bands: one where one face and one band see all of it.
fn add_pieces(pieces: &mut [Vec<Piece>], bands: &[Band], content: Content, index: usize) {
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
        if corners.is_empty() {
            continue;
        }
        let [first, last] = rows(corners, layout.side).map(|row| face * layout.side + row);
        let piece = Piece {
            shape: index as u32,
            face,
        };
        let before = bands.partition_point(|band| band.rows[1] < first);
        let reached = bands[before..]
            .iter()
            .take_while(|band| band.rows[0] <= last);
        for (_, pieces) in reached.zip(&mut pieces[before..]) {
            pieces.push(piece);
        }
    }
}

//! The numbers of a GMSH file, and the tags by which they name each other.

use super::super::cursor::{Cursor, NumberType};
use super::super::packed::damaged;
use super::super::scan::{Scanner, require, sort_ids, with_room};
use crate::error::ParseError;

/// Cell types of VTK and numbers of nodes, by the numbers of element types from 1.
pub(super) const ELEMENTS: [(i64, usize); 31] = [
    (3, 2),
    (5, 3),
    (9, 4),
    (10, 4),
    (12, 8),
    (13, 6),
    (14, 5),
    (21, 3),
    (22, 6),
    (28, 9),
    (24, 10),
    (29, 27),
    (32, 18),
    (37, 14),
    (1, 1),
    (23, 8),
    (25, 20),
    (26, 15),
    (27, 13),
    (69, 9),
    (69, 10),
    (69, 12),
    (69, 15),
    (69, 15),
    (69, 21),
    (35, 4),
    (35, 5),
    (35, 6),
    (71, 20),
    (71, 35),
    (71, 56),
];

/// Numbers as text or binary.
pub(super) struct Input<'a> {
    pub(super) text: Scanner<'a>,
    pub(super) binary: bool,
    pub(super) big_endian: bool,
}

impl Input<'_> {
    pub(super) fn number(&mut self, kind: NumberType) -> Result<f64, ParseError> {
        if !self.binary {
            return self.text.number("a number");
        }
        let mut data = Cursor::new(self.text.rest(), self.big_endian);
        let number = data.number(kind)?;
        self.text.advance(data.position());
        Ok(number)
    }

    pub(super) fn integer(&mut self, kind: NumberType) -> Result<i64, ParseError> {
        if !self.binary {
            return self.text.integer("a number");
        }
        let mut data = Cursor::new(self.text.rest(), self.big_endian);
        let number = data.integer(kind)?;
        self.text.advance(data.position());
        Ok(number)
    }

    pub(super) fn count(&mut self, kind: NumberType) -> Result<u64, ParseError> {
        let count = self.integer(kind)?;
        u64::try_from(count).map_err(|_| damaged("a number of nodes or elements is negative"))
    }

    /// Goes to where binary numbers start.
    pub(super) fn start(&mut self) {
        if self.binary {
            self.text.start_of_binary();
        }
    }

    /// Fails unless so many numbers can be there, before memory is taken for them.
    pub(super) fn require(&self, count: u64, size: u64) -> Result<(), ParseError> {
        let size = if self.binary { size } else { 1 };
        require(count.saturating_mul(size), self.text.rest().len())
    }
}

/// The tags that nodes or elements have, and their places.
#[derive(Default)]
pub(super) struct Tags {
    /// By rising tag; left out where tags count from one.
    sorted: Vec<(i64, u32)>,
}

impl Tags {
    pub(super) fn new(tags: &[i64]) -> Result<Self, ParseError> {
        if tags.iter().zip(1..).all(|(&tag, place)| tag == place) {
            return Ok(Self::default());
        }
        let mut order = with_room(tags.len())?;
        order.extend(0..tags.len() as u32);
        sort_ids(&mut order, &mut |a, b| tags[a as usize].cmp(&tags[b as usize]));
        let mut sorted = with_room(tags.len())?;
        sorted.extend(order.into_iter().map(|place| (tags[place as usize], place)));
        Ok(Self { sorted })
    }

    /// The place of a tag; what cannot be where there is none.
    pub(super) fn place(&self, tag: i64) -> i64 {
        if self.sorted.is_empty() {
            return tag - i64::from(tag > i64::MIN);
        }
        let found = self.sorted.binary_search_by_key(&tag, |&(tag, _)| tag);
        found.map_or(-1, |found| i64::from(self.sorted[found].1))
    }
}

//! Sums of classes of loops, of which some come to equal others.

use core::mem;
use std::collections::BinaryHeap;

use crate::error::OutOfMemory;
use crate::field::arrays::{append, copied, push, with_room};
use crate::support::memory;

/// The work with one class in a sum, and in one whose classes are replaced.
const SUMMED: u64 = 4;
const REPLACED: u64 = 40;

/// What is no list.
const NO_LIST: u32 = u32::MAX;

/// A sum of classes, each once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sum {
    Nothing,
    One(u32),
    /// A list, by its place among them.
    Many(u32),
}

/// What became of a class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    Alive,
    /// It equals a sum of older ones.
    Equals(Sum),
}

/// The classes of loops so far, numbered as they begin.
#[derive(Debug, Default)]
pub(super) struct Classes {
    /// The vertices at which they begin.
    births: Vec<u32>,
    ends: Vec<End>,
    /// How many have ended.
    ended: u32,
    lists: Vec<List>,
    /// Room that is used again: classes that are to be replaced, the youngest first, and what a sum is made in.
    heap: BinaryHeap<u32>,
    sum: Vec<u32>,
    /// The work that was done and not yet told.
    pub(super) work: u64,
}

/// Several classes.
#[derive(Debug)]
struct List {
    /// In ascending order.
    classes: Vec<u32>,
    /// How many classes had ended when all of these were alive.
    valid: u32,
}

impl Classes {
    /// Begins a class.
    pub(super) fn begin(&mut self, vertex: u32) -> Result<Sum, OutOfMemory> {
        push(&mut self.births, vertex)?;
        push(&mut self.ends, End::Alive)?;
        Ok(Sum::One(self.births.len() as u32 - 1))
    }

    /// The vertices at which those begin that have not ended, in their order.
    pub(super) fn essential(&self) -> Result<Vec<u32>, OutOfMemory> {
        let mut essential = Vec::new();
        for (&vertex, &end) in self.births.iter().zip(&self.ends) {
            if end == End::Alive {
                push(&mut essential, vertex)?;
            }
        }
        Ok(essential)
    }

    /// Ends the youngest class of a sum, unless there is none.
    pub(super) fn fill(&mut self, around: Sum) -> Result<(), OutOfMemory> {
        let (youngest, others) = match self.alive(around)? {
            Sum::Nothing => return Ok(()),
            Sum::One(class) => (class, Sum::Nothing),
            Sum::Many(list) => {
                let list = &self.lists[list as usize].classes;
                let youngest = list[list.len() - 1];
                self.sum.clear();
                append(&mut self.sum, &list[..list.len() - 1])?;
                (youngest, self.listed()?)
            }
        };
        self.ended += 1;
        self.ends[youngest as usize] = End::Equals(others);
        Ok(())
    }

    /// What is in one of the two, but not in both.
    pub(super) fn add(&mut self, a: Sum, b: Sum) -> Result<Sum, OutOfMemory> {
        if a == b {
            return Ok(Sum::Nothing);
        }
        if a == Sum::Nothing {
            return Ok(b);
        }
        if b == Sum::Nothing {
            return Ok(a);
        }
        let (a, b) = (self.alive(a)?, self.alive(b)?);
        let (one, other) = ([one_of(a)], [one_of(b)]);
        let mut sum = mem::take(&mut self.sum);
        let (mut a, mut b) = (self.classes(a, &one), self.classes(b, &other));
        let most = a.len() + b.len();
        sum.clear();
        if sum.capacity() < most {
            sum = with_room(most + most / 2)?;
        }
        while let ([x, after @ ..], [y, behind @ ..]) = (a, b) {
            if x == y {
                (a, b) = (after, behind);
            } else if x < y {
                sum.push(*x);
                a = after;
            } else {
                sum.push(*y);
                b = behind;
            }
        }
        sum.extend_from_slice(a);
        sum.extend_from_slice(b);
        self.sum = sum;
        self.work += SUMMED * most as u64;
        self.listed()
    }

    fn classes<'s>(&'s self, sum: Sum, one: &'s [u32; 1]) -> &'s [u32] {
        match sum {
            Sum::Nothing => &[],
            Sum::One(_) => one,
            Sum::Many(list) => &self.lists[list as usize].classes,
        }
    }

    /// What `self.sum` has, ascending.
    fn listed(&mut self) -> Result<Sum, OutOfMemory> {
        Ok(match self.sum[..] {
            [] => Sum::Nothing,
            [one] => Sum::One(one),
            _ => {
                let list = List { classes: copied(&self.sum)?, valid: self.ended };
                push(&mut self.lists, list)?;
                Sum::Many(self.lists.len() as u32 - 1)
            }
        })
    }

    /// The sum with classes that ended replaced.
    fn alive(&mut self, sum: Sum) -> Result<Sum, OutOfMemory> {
        let list = match sum {
            Sum::Nothing => return Ok(sum),
            Sum::One(class) if self.ends[class as usize] == End::Alive => return Ok(sum),
            Sum::One(class) => {
                self.heap.push(class);
                NO_LIST
            }
            Sum::Many(list) => {
                let known = &mut self.lists[list as usize];
                if known.valid == self.ended {
                    return Ok(self.shrunk(list));
                }
                known.valid = self.ended;
                self.work += SUMMED * known.classes.len() as u64;
                if known.classes.iter().all(|&class| self.ends[class as usize] == End::Alive) {
                    return Ok(self.shrunk(list));
                }
                self.queue(list)?;
                list
            }
        };
        self.replace_ended()?;
        if list == NO_LIST {
            return self.listed();
        }
        // Whoever has the list has the new one from now on.
        self.lists[list as usize].classes = copied(&self.sum)?;
        Ok(self.shrunk(list))
    }

    /// A list by the shortest name.
    fn shrunk(&self, list: u32) -> Sum {
        match self.lists[list as usize].classes[..] {
            [] => Sum::Nothing,
            [one] => Sum::One(one),
            _ => Sum::Many(list),
        }
    }

    /// Turns the heap into a sum of classes that are alive.
    fn replace_ended(&mut self) -> Result<(), OutOfMemory> {
        self.sum.clear();
        while let Some(class) = self.heap.pop() {
            self.work += REPLACED;
            if self.heap.peek() == Some(&class) {
                self.heap.pop();
                continue;
            }
            match self.ends[class as usize] {
                End::Alive => push(&mut self.sum, class)?,
                End::Equals(Sum::Nothing) => {}
                End::Equals(Sum::One(older)) => {
                    let older = self.follow(class, older);
                    self.heap.push(older);
                }
                End::Equals(Sum::Many(list)) => self.queue(list)?,
            }
        }
        self.sum.reverse();
        Ok(())
    }

    /// Puts the classes of a list on the heap.
    fn queue(&mut self, list: u32) -> Result<(), OutOfMemory> {
        let list = &self.lists[list as usize].classes;
        if self.heap.capacity() - self.heap.len() < list.len() {
            // A heap that grows is moved.
            memory::ensure(4 * 2 * (self.heap.capacity() + list.len()) as u64)?;
        }
        self.work += REPLACED * list.len() as u64;
        self.heap.extend(list.iter().copied());
        Ok(())
    }

    /// The end of a chain of classes each of which equals one older; the chain is shortened.
    fn follow(&mut self, mut class: u32, mut older: u32) -> u32 {
        while let End::Equals(Sum::One(after)) = self.ends[older as usize] {
            self.ends[class as usize] = End::Equals(Sum::One(after));
            (class, older) = (older, after);
        }
        older
    }
}

/// The class of a sum of one.
fn one_of(sum: Sum) -> u32 {
    if let Sum::One(class) = sum { class } else { 0 }
}

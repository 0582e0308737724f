//! GMSH's own files, versions 2 and 4.1, text or binary: surfaces, and of volumes the outer surface.

mod input;

use input::{ELEMENTS, Input, Tags};

use super::arrays::Components;
use super::assembly::{Assembly, check_count};
use super::cells::{Cells, kind};
use super::cursor::NumberType;
use super::format::Format;
use super::mesh_data::{MeshData, MeshFormat};
use super::packed::{damaged, most_unpacked};
use super::scan::{Scanner, filled, push, reserve};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "msh",
    extensions: &["msh"],
    description: "GMSH, versions 2 and 4.1, text or binary, with fields; of volumes the outer surface",
    sniff: |bytes| Scanner::new(bytes).word().is_some_and(|word| word.starts_with(b"$")) && holds_format(bytes),
    read,
    write: None,
};

fn holds_format(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(1 << 12)];
    head.windows(11).any(|window| window == b"$MeshFormat")
}

/// Values of nodes or elements.
struct View {
    is_of_nodes: bool,
    name: String,
    components: u64,
    tags: Vec<i64>,
    values: Vec<f64>,
}

struct Reader<'a> {
    input: Input<'a>,
    version: f64,
    assembly: Assembly,
    node_tags: Vec<i64>,
    element_tags: Vec<i64>,
    types: Vec<u8>,
    /// The tags of all elements' nodes.
    nodes: Vec<i64>,
    views: Vec<View>,
}

fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let mut reader = Reader {
        input: Input { text: Scanner::new(bytes), binary: false, big_endian: false },
        version: 0.0,
        assembly: Assembly::default(),
        node_tags: Vec::new(),
        element_tags: Vec::new(),
        types: Vec::new(),
        nodes: Vec::new(),
        views: Vec::new(),
    };
    while let Some(keyword) = reader.input.text.word() {
        if !keyword.starts_with(b"$") || keyword.starts_with(b"$End") {
            reader.input.text.rest_of_line();
            continue;
        }
        match keyword {
            b"$MeshFormat" => reader.read_head()?,
            b"$Nodes" if reader.version >= 4.0 => reader.read_node_blocks()?,
            b"$Nodes" => reader.read_nodes()?,
            b"$Elements" if reader.version >= 4.0 => reader.read_element_blocks()?,
            b"$Elements" => reader.read_elements()?,
            b"$NodeData" => reader.read_view(true)?,
            b"$ElementData" => reader.read_view(false)?,
            keyword => {
                let end = [b"$End", &keyword[1..]].concat();
                reader.pass(&end);
            }
        }
    }
    reader.finish(most_unpacked(bytes.len()))
}

impl Reader<'_> {
    /// Passes over a section, which may be binary.
    fn pass(&mut self, end: &[u8]) {
        let rest = self.input.text.rest();
        let place = rest.windows(end.len()).position(|window| window == end);
        self.input.text.advance(place.map_or(rest.len(), |place| place + end.len()));
    }

    fn read_head(&mut self) -> Result<(), ParseError> {
        self.version = self.input.text.number("the version")?;
        let is_binary = self.input.text.integer("the kind of file")? == 1;
        let size = self.input.text.integer("the size of numbers")?;
        if !(self.version < 3.0 || (4.1..4.2).contains(&self.version)) || size != 8 {
            let feature = format!("version {} and numbers of {size} bytes", self.version);
            return Err(ParseError::UnsupportedFeature { format: MeshFormat::Msh.name().to_owned(), feature });
        }
        if is_binary {
            self.input.text.rest_of_line();
            self.input.binary = true;
            self.input.big_endian = self.input.integer(NumberType::I32)? != 1;
        }
        Ok(())
    }

    fn read_nodes(&mut self) -> Result<(), ParseError> {
        let count = self.input.text.integer("the number of nodes")?;
        let count = u64::try_from(count).map_err(|_| damaged("the number of nodes is negative"))?;
        self.input.start();
        self.reserve_nodes(count, 28)?;
        for _ in 0..count {
            let tag = self.input.integer(NumberType::I32)?;
            push(&mut self.node_tags, tag)?;
            self.read_point()?;
        }
        Ok(())
    }

    fn reserve_nodes(&mut self, count: u64, size: u64) -> Result<(), ParseError> {
        check_count("vertices", count)?;
        self.input.require(count, size)?;
        reserve(&mut self.node_tags, count as usize)?;
        reserve(&mut self.assembly.positions, 3 * count as usize)
    }

    fn read_point(&mut self) -> Result<(), ParseError> {
        for _ in 0..3 {
            let value = self.input.number(NumberType::F64)?;
            push(&mut self.assembly.positions, value)?;
        }
        Ok(())
    }

    /// Version 4: blocks of tags and then of points.
    fn read_node_blocks(&mut self) -> Result<(), ParseError> {
        self.input.start();
        let blocks = self.input.count(NumberType::U64)?;
        let count = self.input.count(NumberType::U64)?;
        for _ in 0..2 {
            self.input.count(NumberType::U64)?;
        }
        self.reserve_nodes(count, 32)?;
        for _ in 0..blocks {
            let dimension = self.input.integer(NumberType::I32)?;
            self.input.integer(NumberType::I32)?;
            let is_parametric = self.input.integer(NumberType::I32)? != 0;
            let count = self.input.count(NumberType::U64)?;
            self.input.require(count, 32)?;
            for _ in 0..count {
                let tag = self.input.integer(NumberType::U64)?;
                push(&mut self.node_tags, tag)?;
            }
            for _ in 0..count {
                self.read_point()?;
                for _ in 0..if is_parametric { dimension.clamp(0, 3) } else { 0 } {
                    self.input.number(NumberType::F64)?;
                }
            }
        }
        Ok(())
    }

    fn read_elements(&mut self) -> Result<(), ParseError> {
        let count = self.input.text.integer("the number of elements")?;
        let count = u64::try_from(count).map_err(|_| damaged("the number of elements is negative"))?;
        self.input.start();
        self.input.require(count, 4)?;
        let mut read = 0;
        while read < count {
            let (mut element_tag, mut own) = (0, 1);
            let number;
            if self.input.binary {
                number = self.input.integer(NumberType::I32)?;
                own = self.input.count(NumberType::I32)?;
            } else {
                element_tag = self.input.integer(NumberType::I32)?;
                number = self.input.integer(NumberType::I32)?;
            }
            let tags = self.input.count(NumberType::I32)?;
            if own == 0 || own > count - read {
                return Err(damaged("the numbers of elements do not add up"));
            }
            for _ in 0..own {
                if self.input.binary {
                    element_tag = self.input.integer(NumberType::I32)?;
                }
                for _ in 0..tags {
                    self.input.integer(NumberType::I32)?;
                }
                self.read_element(element_tag, number, NumberType::I32)?;
            }
            read += own;
        }
        Ok(())
    }

    fn read_element_blocks(&mut self) -> Result<(), ParseError> {
        self.input.start();
        let blocks = self.input.count(NumberType::U64)?;
        for _ in 0..3 {
            self.input.count(NumberType::U64)?;
        }
        for _ in 0..blocks {
            self.input.integer(NumberType::I32)?;
            self.input.integer(NumberType::I32)?;
            let number = self.input.integer(NumberType::I32)?;
            let count = self.input.count(NumberType::U64)?;
            self.input.require(count, 8)?;
            for _ in 0..count {
                let tag = self.input.integer(NumberType::U64)?;
                self.read_element(tag, number, NumberType::U64)?;
            }
        }
        Ok(())
    }

    fn read_element(&mut self, tag: i64, number: i64, kind: NumberType) -> Result<(), ParseError> {
        let place = usize::try_from(number - 1).ok().filter(|&place| place < ELEMENTS.len());
        let Some(place) = place else {
            return Err(damaged(&format!("elements of the type {number} are not known")));
        };
        push(&mut self.element_tags, tag)?;
        push(&mut self.types, place as u8)?;
        for _ in 0..ELEMENTS[place].1 {
            let node = self.input.integer(kind)?;
            push(&mut self.nodes, node)?;
        }
        Ok(())
    }

    /// Values: names, then times, then integers that say how many there are.
    fn read_view(&mut self, is_of_nodes: bool) -> Result<(), ParseError> {
        let text = &mut self.input.text;
        let mut name = String::new();
        for place in 0..text.integer("the number of names")? {
            text.next_row();
            let line = text.rest_of_line().trim_ascii();
            if place == 0 {
                let line = line.strip_prefix(b"\"").unwrap_or(line);
                name = String::from_utf8_lossy(line.strip_suffix(b"\"").unwrap_or(line)).into_owned();
            }
        }
        for _ in 0..text.integer("the number of times")? {
            text.number("a time")?;
        }
        let (mut components, mut count) = (1, 0);
        for place in 0..text.integer("the number of integers")? {
            let value = text.integer("an integer")?;
            match place {
                1 => components = u64::try_from(value).unwrap_or(0),
                2 => count = u64::try_from(value).unwrap_or(0),
                _ => {}
            }
        }
        self.input.start();
        let size = components.saturating_mul(8).saturating_add(4);
        self.input
            .require(count.saturating_mul(if self.input.binary { 1 } else { components.saturating_add(1) }), size)?;
        let mut view = View { is_of_nodes, name, components, tags: Vec::new(), values: Vec::new() };
        for _ in 0..count {
            let tag = self.input.integer(NumberType::I32)?;
            push(&mut view.tags, tag)?;
            for _ in 0..components {
                let value = self.input.number(NumberType::F64)?;
                push(&mut view.values, value)?;
            }
        }
        push(&mut self.views, view)
    }

    /// `most` is how many bytes values may take that the file has only a part of.
    fn finish(self, most: u64) -> Result<MeshData, ParseError> {
        let Self { mut assembly, node_tags, element_tags, types, mut nodes, views, .. } = self;
        let places = Tags::new(&node_tags)?;
        nodes.iter_mut().for_each(|node| *node = places.place(*node));
        let vertices = node_tags.len() as u64;
        let number = |place: u8| ELEMENTS[usize::from(place)].0;
        let has_volumes = types.iter().any(|&place| kind(number(place)).is_volume());
        let mut cells = Cells::new(vertices, has_volumes);
        let mut start = 0;
        for &place in &types {
            let end = start + ELEMENTS[usize::from(place)].1;
            cells.add(&mut assembly, number(place), &nodes[start..end])?;
            start = end;
        }
        drop(nodes);
        cells.finish(&mut assembly)?;
        let elements = Tags::new(&element_tags)?;
        for view in views {
            let (tags, count) = if view.is_of_nodes { (&places, node_tags.len()) } else { (&elements, types.len()) };
            if view.components == 0 || view.values.is_empty() {
                continue;
            }
            // Values may come in any order, and not for all.
            let width = view.components as usize;
            let size = width.saturating_mul(count);
            if size as u64 > most / 8 {
                assembly.skipped(format!("view `{}` of {width} components", view.name), size as u64);
                continue;
            }
            let mut all = filled(f64::NAN, size)?;
            for (&tag, values) in view.tags.iter().zip(view.values.chunks_exact(width)) {
                let place = usize::try_from(tags.place(tag)).ok().filter(|&place| place < count);
                if let Some(place) = place {
                    all[place * width..][..width].copy_from_slice(values);
                }
            }
            let mut parts = Components::new(&view.name, view.components, count as u64)?.with_magnitude();
            all.into_iter().for_each(|value| parts.push(value));
            let mut result = Ok(());
            parts.finish(&mut |name, values| {
                if view.is_of_nodes {
                    assembly.field(name, values);
                } else if result.is_ok() {
                    result = cells.field(&mut assembly, name, &values);
                }
            })?;
            result?;
        }
        assembly.finish(MeshFormat::Msh)
    }
}

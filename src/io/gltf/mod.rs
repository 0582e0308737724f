//! glTF 2: scenes of meshes, binary or as JSON with its buffers embedded. All primitives of a scene become one mesh.

mod accessor;
mod transform;
mod write;

use accessor::{BINARY_CHUNK, JSON_CHUNK, MAGIC, Scene, unsupported};
use transform::{IDENTITY, Transform, apply, is_mirror, product};

use super::arrays::Components;
use super::assembly::{Assembly, check_count};
use super::format::{Format, Writer};
use super::json::Json;
use super::mesh_data::{MeshData, MeshFormat};
use super::packed::{damaged, most_unpacked};
use super::scan::{filled, push, require, reserve};
use crate::error::ParseError;

pub(super) const FORMAT: Format = Format {
    name: "glb",
    extensions: &["glb", "gltf"],
    description: "glTF, binary or with embedded buffers; attributes `_NAME` and colors as fields",
    sniff: |bytes| bytes.starts_with(MAGIC) || is_json(bytes),
    read,
    write: Some(Writer { text: false, binary: true, fields: true, write: write::write }),
};

/// A scene as JSON says which version of glTF it is.
fn is_json(bytes: &[u8]) -> bool {
    let holds = |word: &[u8]| bytes.windows(word.len()).take(1 << 20).any(|window| window == word);
    bytes.trim_ascii_start().starts_with(b"{") && holds(b"\"asset\"") && (holds(b"\"meshes\"") || holds(b"\"scenes\""))
}

fn read(bytes: &[u8]) -> Result<MeshData, ParseError> {
    let (json, binary) = if bytes.starts_with(MAGIC) { chunks(bytes)? } else { (bytes, &[][..]) };
    let text = core::str::from_utf8(super::scan::without_byte_order_mark(json));
    let json = Json::parse(text.map_err(|_| damaged("the JSON text is not UTF-8"))?)?;
    for extension in json.list("extensionsRequired").iter().filter_map(Json::text) {
        if extension.contains("draco") || extension.contains("meshopt") {
            return Err(unsupported(&format!("meshes packed by `{extension}`")));
        }
    }
    let scene = Scene::new(json, binary)?;
    let mut builder = Builder {
        visited: filled(false, scene.json.list("nodes").len())?,
        scene,
        assembly: Assembly::default(),
        parts: Vec::new(),
        most: most_unpacked(bytes.len()),
        others: 0,
    };
    builder.add_all()?;
    if builder.others > 0 {
        builder.assembly.skipped(format!("{} primitives of points or lines", builder.others), builder.others);
    }
    builder.assembly.fill_up()?;
    if builder.parts.iter().any(|&part| part > 0.0) {
        builder.assembly.face_field("part", builder.parts);
    }
    builder.assembly.finish(MeshFormat::Glb)
}

/// The JSON text and the bytes of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8]), ParseError> {
    let word =
        |place: usize| bytes.get(place..).and_then(|rest| rest.first_chunk()).map(|&raw| u32::from_le_bytes(raw));
    if word(4) != Some(2) {
        return Err(unsupported("another version than 2"));
    }
    let (mut json, mut binary, mut place) = (&[][..], &[][..], 12);
    while let (Some(length), Some(kind)) = (word(place), word(place + 4)) {
        let body = &bytes[place + 8..];
        require(u64::from(length), body.len())?;
        let body = &body[..length as usize];
        match kind {
            JSON_CHUNK if json.is_empty() => json = body,
            BINARY_CHUNK if binary.is_empty() => binary = body,
            _ => {}
        }
        place += 8 + length as usize;
    }
    Ok((json, binary))
}

struct Builder<'a> {
    scene: Scene<'a>,
    assembly: Assembly,
    visited: Vec<bool>,
    /// For every face the primitive that it is of.
    parts: Vec<f64>,
    /// Bytes that positions may take: one mesh may stand in many places.
    most: u64,
    others: u64,
}

impl Builder<'_> {
    fn add_all(&mut self) -> Result<(), ParseError> {
        let json = &self.scene.json;
        let scene = json.count_of("scene").unwrap_or(0);
        let mut waiting: Vec<(u64, Transform)> = Vec::new();
        if let Some(scene) = json.list("scenes").get(scene as usize) {
            for node in scene.list("nodes").iter().filter_map(Json::count) {
                push(&mut waiting, (node, IDENTITY))?;
            }
        } else if json.list("nodes").is_empty() {
            // Meshes that stand nowhere.
            for mesh in 0..json.list("meshes").len() as u64 {
                self.add_mesh(mesh, &IDENTITY)?;
            }
            return Ok(());
        } else {
            for node in 0..json.list("nodes").len() as u64 {
                push(&mut waiting, (node, IDENTITY))?;
            }
        }
        waiting.reverse();
        while let Some((place, outer)) = waiting.pop() {
            let node = self.scene.item("nodes", place)?;
            if core::mem::replace(&mut self.visited[place as usize], true) {
                continue;
            }
            let transform = product(&outer, &transform::of_node(node));
            let children = node.list("children").iter().rev().filter_map(Json::count);
            for child in children {
                push(&mut waiting, (child, transform))?;
            }
            if let Some(mesh) = node.count_of("mesh") {
                self.add_mesh(mesh, &transform)?;
            }
        }
        Ok(())
    }

    fn add_mesh(&mut self, place: u64, transform: &Transform) -> Result<(), ParseError> {
        let count = self.scene.item("meshes", place)?.list("primitives").len();
        for primitive in 0..count {
            self.add_primitive(place, primitive, transform)?;
        }
        Ok(())
    }

    fn add_primitive(&mut self, mesh: u64, place: usize, transform: &Transform) -> Result<(), ParseError> {
        let Self { scene, assembly, parts, most, others, .. } = self;
        let primitive = &scene.item("meshes", mesh)?.list("primitives")[place];
        let mode = primitive.count_of("mode").unwrap_or(4);
        let attributes = primitive.get("attributes").map_or(&[][..], Json::entries);
        let positions = attributes.iter().find(|(name, _)| name == "POSITION").and_then(|(_, value)| value.count());
        let Some(positions) = positions.filter(|_| (4..=6).contains(&mode)) else {
            *others += 1;
            return Ok(());
        };
        let positions = scene.accessor(positions)?;
        if positions.components != 3 {
            return Err(damaged("positions should have three components"));
        }
        let first = (assembly.positions.len() / 3) as u64;
        let vertices = first + positions.count;
        check_count("vertices", vertices)?;
        if vertices * 24 > *most {
            return Err(ParseError::TooLarge { element: "vertices".to_owned(), count: vertices });
        }
        reserve(&mut assembly.positions, 3 * positions.count as usize)?;
        let (mut point, mut axis) = ([0.0; 3], 0);
        scene.numbers(&positions, &mut |value| {
            point[axis] = value;
            axis = (axis + 1) % 3;
            if axis == 0 {
                assembly.positions.extend(apply(transform, point));
            }
            Ok(())
        })?;
        let mut corners: Vec<u32> = Vec::new();
        match primitive.count_of("indices") {
            None => {
                reserve(&mut corners, positions.count as usize)?;
                corners.extend(0..positions.count as u32);
            }
            Some(indices) => {
                let indices = scene.accessor(indices)?;
                reserve(&mut corners, indices.count as usize)?;
                scene.numbers(&indices, &mut |value| {
                    corners.push(value as u32);
                    Ok(())
                })?;
            }
        }
        let part = parts.last().map_or(0.0, |last| last + 1.0);
        let is_mirrored = is_mirror(transform);
        let mut add = |a: u32, b: u32, c: u32| {
            for corner in if is_mirrored { [a, c, b] } else { [a, b, c] } {
                // An id beyond those of this primitive must not be one of the next.
                let id = if u64::from(corner) < positions.count { first + u64::from(corner) } else { u64::MAX >> 1 };
                assembly.corner(id as i64, vertices)?;
            }
            assembly.close_polygon()?;
            push(parts, part)
        };
        match mode {
            4 => corners.chunks_exact(3).try_for_each(|face| add(face[0], face[1], face[2]))?,
            5 => corners.windows(3).enumerate().try_for_each(|(place, face)| {
                if place % 2 == 0 { add(face[0], face[1], face[2]) } else { add(face[1], face[0], face[2]) }
            })?,
            _ => corners.windows(2).skip(1).try_for_each(|face| add(corners[0], face[0], face[1]))?,
        }
        for (name, value) in attributes {
            if let Some(title) = field_name(name)
                && let Some(place) = value.count()
            {
                let accessor = scene.accessor(place)?;
                if accessor.count == positions.count && accessor.count > 0 {
                    add_field(scene, &accessor, title, first, assembly)?;
                }
            }
        }
        Ok(())
    }
}

fn add_field(
    scene: &Scene<'_>,
    accessor: &accessor::Accessor,
    title: &str,
    first: u64,
    assembly: &mut Assembly,
) -> Result<(), ParseError> {
    let mut parts = Components::new(title, accessor.components, accessor.count)?;
    scene.numbers(accessor, &mut |value| {
        parts.push(value);
        Ok(())
    })?;
    let mut result = Ok(());
    parts.finish(&mut |name, values| {
        if result.is_ok() {
            result = assembly.more_of_field(name, first, values);
        }
    })?;
    result
}

/// What the field of an attribute is called: those of an application's own begin with `_`. Normals, tangents and places in pictures are
/// no fields.
fn field_name(attribute: &str) -> Option<&str> {
    if attribute.starts_with("COLOR_") {
        return Some(attribute);
    }
    attribute.strip_prefix('_').filter(|name| !name.is_empty())
}

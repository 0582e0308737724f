//! What the sources do against the rules.

use super::graph::{Crate, Edge, circles};
use super::tables::Rules;
use super::words::forbidden;

/// Everything against the rules. Files are named by their paths below `src`, with slashes.
pub(crate) fn violations(files: &[(String, String)], rules: &Rules) -> Vec<String> {
    let mut edges = Crate::new(files).edges();
    // A file that names another more than once does so for the first time; a folder's name alone says less.
    edges.sort_by_key(|edge| (edge.from.clone(), edge.to.clone(), edge.is_folder, edge.line));
    edges.dedup_by(|a, b| a.from == b.from && a.to == b.to);
    let words = files.iter().flat_map(|(path, source)| forbidden(path, source, rules));
    let unplaced = files.iter().flat_map(|(path, _)| unplaced(path, rules));
    let layers = edges.iter().filter_map(|edge| out_of_layer(edge, rules));
    let orders = edges.iter().filter_map(|edge| out_of_order(edge, rules));
    let circles = circles(&edges).into_iter().map(|circle| {
        let ways: Vec<String> = circle.iter().map(|edge| shown(edge)).collect();
        format!("a circle: {}", ways.join("; "))
    });
    let mut found: Vec<String> = words.chain(unplaced).chain(layers).chain(orders).chain(circles).collect();
    found.sort();
    found.dedup();
    found
}

/// Names in the tables that no file has.
pub(crate) fn strangers(files: &[(String, String)], rules: &Rules) -> Vec<String> {
    let is_there = |name: &str| {
        let (file, folder) = (format!("{name}.rs"), format!("{name}/"));
        files.iter().any(|(path, _)| *path == file || path.starts_with(&folder))
    };
    let layers = rules.layers.iter().map(|(module, _)| (*module).to_owned());
    let orders = rules
        .orders
        .iter()
        .flat_map(|(folder, groups)| groups.iter().copied().flatten().map(move |name| format!("{folder}/{name}")));
    let platform = rules.platform.iter().chain(rules.state).map(|path| path.trim_end_matches(".rs").to_owned());
    layers.chain(orders).chain(platform).filter(|name| !is_there(name)).collect()
}

fn shown(edge: &Edge) -> String {
    format!("{}:{} uses {} (`{}`)", edge.from, edge.line, edge.to, edge.path)
}

fn module_of(path: &str) -> &str {
    path.split('/').next().unwrap_or(path).trim_end_matches(".rs")
}

/// The file or folder of `folder` in which a file is.
fn entry<'a>(path: &'a str, folder: &str) -> Option<&'a str> {
    path.strip_prefix(folder)?.strip_prefix('/').map(module_of)
}

/// A file that the tables forget.
fn unplaced(path: &str, rules: &Rules) -> Vec<String> {
    let module = module_of(path);
    let has_layer = ["lib", "wasm"].contains(&module) || rules.layers.iter().any(|(name, _)| *name == module);
    let layer = (!has_layer).then(|| format!("{path}: the module `{module}` has no place in the layers yet"));
    let orders = rules.orders.iter().filter_map(|(folder, groups)| {
        let name = entry(path, folder)?;
        let is_placed = groups.iter().any(|group| group.contains(&name));
        (!is_placed).then(|| format!("{path}: `{name}` has no place in the order of `{folder}` yet"))
    });
    layer.into_iter().chain(orders).collect()
}

fn out_of_layer(edge: &Edge, rules: &Rules) -> Option<String> {
    let (from, to) = (module_of(&edge.from), module_of(&edge.to));
    if from == to || from == "lib" || from == "wasm" {
        return None;
    }
    let (_, allowed) = rules.layers.iter().find(|(name, _)| *name == from)?;
    (!allowed.contains(&to)).then(|| format!("{}, but `{from}` may only use {allowed:?}", shown(edge)))
}

/// Two files have an order in the one folder that has both in different entries.
fn out_of_order(edge: &Edge, rules: &Rules) -> Option<String> {
    let find = |&(folder, groups): &(&'static str, &'static [&'static [&'static str]])| {
        let (from, to) = (entry(&edge.from, folder)?, entry(&edge.to, folder)?);
        let group = |name| groups.iter().position(|group| group.contains(&name));
        // To name the folder that one is in, as in `use super::super::x`, uses nothing of it.
        if from == to || (to == "mod" && edge.is_folder) {
            return None;
        }
        (group(from)? < group(to)?).then(|| format!("{}, but in `{folder}` {to} comes after {from}", shown(edge)))
    };
    rules.orders.iter().find_map(find)
}

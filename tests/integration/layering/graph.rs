//! Which file of the crate uses which: names are followed through re-exports to the file that declares them.

use std::collections::{BTreeMap, BTreeSet};

use super::scopes::{Scope, scopes_of};

/// That a file names something of another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Edge {
    pub from: String,
    pub line: usize,
    /// As it is written, groups undone.
    pub path: String,
    pub to: String,
    /// Whether only a folder's module is named, and nothing in its `mod.rs`.
    pub is_folder: bool,
}

/// The crate as a tree of modules. Files are named by their paths below `src`.
pub(crate) struct Crate {
    modules: Vec<Module>,
}

struct Module {
    file: String,
    parent: usize,
    children: BTreeMap<String, usize>,
    scope: Scope,
}

/// What a path leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Target {
    Module(usize),
    /// Something that is declared in that module.
    Item(usize),
}

const ROOT: usize = 0;
/// Longer chains of re-exports are circles.
const LONGEST_CHAIN: usize = 32;

impl Crate {
    pub(crate) fn new(files: &[(String, String)]) -> Self {
        let root =
            Module { file: "lib.rs".to_owned(), parent: ROOT, children: BTreeMap::new(), scope: Scope::default() };
        let mut found = Self { modules: vec![root] };
        // Folders first, so that no module is made before its file is known.
        let mut files: Vec<_> = files.iter().map(|(file, source)| (module_path(file), file, source)).collect();
        files.sort();
        for (path, file, source) in files {
            for scope in scopes_of(source) {
                let inner = path.iter().copied().chain(scope.module.iter().map(String::as_str));
                let module = found.module(inner, file);
                found.modules[module].scope = scope;
            }
        }
        found
    }

    /// The module with that path, made where it is new.
    fn module<'a>(&mut self, path: impl Iterator<Item = &'a str>, file: &str) -> usize {
        path.fold(ROOT, |parent, name| {
            if let Some(&child) = self.modules[parent].children.get(name) {
                return child;
            }
            let child = self.modules.len();
            self.modules.push(Module {
                file: file.to_owned(),
                parent,
                children: BTreeMap::new(),
                scope: Scope::default(),
            });
            self.modules[parent].children.insert(name.to_owned(), child);
            child
        })
    }

    /// What every file uses of others.
    pub(crate) fn edges(&self) -> Vec<Edge> {
        let mut edges = Vec::new();
        for (from, module) in self.modules.iter().enumerate() {
            for import in &module.scope.uses {
                if import.is_reexport && self.only_hands_on(from, &import.path, &import.alias) {
                    continue;
                }
                self.add(from, &import.path, import.line, &mut edges);
                if import.alias == "*" {
                    self.add_all_of(from, &import.path, import.line, &mut edges);
                }
            }
            for path in &module.scope.paths {
                self.add(from, &path.path, path.line, &mut edges);
            }
        }
        edges
    }

    fn add(&self, from: usize, path: &[String], line: usize, edges: &mut Vec<Edge>) {
        let Some(target) = self.resolve(from, path, 0) else { return };
        let (Target::Module(to) | Target::Item(to)) = target;
        let (source, file) = (&self.modules[from].file, &self.modules[to].file);
        if source == file {
            return;
        }
        let is_folder = matches!(target, Target::Module(_)) && (file.ends_with("/mod.rs") || file == "lib.rs");
        edges.push(Edge { from: source.clone(), line, path: path.join("::"), to: file.clone(), is_folder });
    }

    /// A star uses what the module declares and all that it re-exports.
    fn add_all_of(&self, from: usize, path: &[String], line: usize, edges: &mut Vec<Edge>) {
        let Some(Target::Module(module)) = self.resolve(from, path, 0) else { return };
        let first = edges.len();
        for import in self.modules[module].scope.uses.iter().filter(|import| import.is_reexport) {
            self.add(module, &import.path, line, edges);
        }
        let source = &self.modules[from].file;
        edges[first..].iter_mut().for_each(|edge| edge.from.clone_from(source));
        edges.retain(|edge| edge.from != edge.to);
        let file = &self.modules[module].file;
        if source != file && !self.modules[module].scope.items.is_empty() {
            edges.push(Edge {
                from: source.clone(),
                line,
                path: format!("{}::*", path.join("::")),
                to: file.clone(),
                is_folder: false,
            });
        }
    }

    /// Whether a folder's `mod.rs`, or `lib.rs`, re-exports something of its own folder and does not use it itself.
    fn only_hands_on(&self, from: usize, path: &[String], alias: &str) -> bool {
        let module = &self.modules[from];
        let is_folder = module.file.ends_with("mod.rs") || module.file == "lib.rs";
        let is_own = match self.resolve(from, path, 0) {
            None => true,
            Some(Target::Module(to) | Target::Item(to)) => self.ancestors(to).any(|above| above == from),
        };
        is_folder && is_own && !module.scope.words.contains_key(alias)
    }

    fn ancestors(&self, module: usize) -> impl Iterator<Item = usize> {
        let above = move |&module: &usize| (module != ROOT).then(|| self.modules[module].parent);
        std::iter::successors(Some(module), above)
    }

    /// What a path leads to, seen from a module; `None` where that is outside of the crate.
    fn resolve(&self, from: usize, path: &[String], chain: usize) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.walk(ROOT, rest, chain),
            "self" => self.walk(from, rest, chain),
            "super" => self.walk(self.modules[from].parent, rest, chain),
            _ => self.find(from, first, rest, chain),
        }
    }

    fn walk(&self, module: usize, path: &[String], chain: usize) -> Option<Target> {
        let Some((first, rest)) = path.split_first() else { return Some(Target::Module(module)) };
        if first == "super" {
            return self.walk(self.modules[module].parent, rest, chain);
        }
        // What a macro declares is not seen; it can only be the module's own.
        self.find(module, first, rest, chain).or(Some(Target::Item(module)))
    }

    /// What a name stands for in a module, and the rest of the path from there.
    fn find(&self, module: usize, name: &str, rest: &[String], chain: usize) -> Option<Target> {
        if chain > LONGEST_CHAIN {
            return None;
        }
        let Module { children, scope, .. } = &self.modules[module];
        // A module and a function may share a name; a path that goes on means the module.
        let child = children.get(name).filter(|_| !rest.is_empty());
        if let Some(&child) = child {
            return self.walk(child, rest, chain);
        }
        if scope.items.contains(name) {
            return Some(Target::Item(module));
        }
        for import in scope.uses.iter().filter(|import| import.alias == name) {
            // `use named;` of a macro names itself.
            let target = self.resolve(module, &import.path, chain + 1);
            match target {
                Some(Target::Module(target)) => return self.walk(target, rest, chain + 1),
                Some(item) => return Some(item),
                None => {}
            }
        }
        if let Some(&child) = children.get(name) {
            return self.walk(child, rest, chain);
        }
        let stars = scope.uses.iter().filter(|import| import.alias == "*");
        let through = |import: &super::scopes::Use| match self.resolve(module, &import.path, chain + 1)? {
            Target::Module(all) if all != module => self.find(all, name, rest, chain + 1),
            _ => None,
        };
        stars.map(through).find(Option::is_some)?
    }
}

/// `a/b.rs` is the module a::b, and so is `a/b/mod.rs`; `lib.rs` is the crate.
fn module_path(file: &str) -> Vec<&str> {
    let path = file.trim_end_matches(".rs");
    let path = path.strip_suffix("/mod").unwrap_or(path);
    if path == "lib" { Vec::new() } else { path.split('/').collect() }
}

/// Files that use each other in a circle: each as a shortest way around, edge by edge, one for every part of the graph in which
/// all files reach each other.
pub(crate) fn circles(edges: &[Edge]) -> Vec<Vec<&Edge>> {
    let mut uses: BTreeMap<&str, BTreeMap<&str, &Edge>> = BTreeMap::new();
    for edge in edges.iter().filter(|edge| !edge.is_folder) {
        uses.entry(&edge.from).or_default().entry(&edge.to).or_insert(edge);
    }
    let mut seen: BTreeSet<&str> = BTreeSet::new();
    let mut found = Vec::new();
    for &file in uses.keys() {
        if seen.contains(file) {
            continue;
        }
        if let Some(circle) = shortest_way(&uses, file, file) {
            // The whole part counts as seen: whatever reaches the file and is reached by it.
            seen.extend(uses.keys().filter(|other| {
                shortest_way(&uses, file, other).is_some() && shortest_way(&uses, other, file).is_some()
            }));
            found.push(circle);
        }
    }
    found
}

/// A way of at least one edge, as short as there is.
fn shortest_way<'a>(
    uses: &BTreeMap<&'a str, BTreeMap<&'a str, &'a Edge>>,
    from: &str,
    to: &str,
) -> Option<Vec<&'a Edge>> {
    let mut came_by: BTreeMap<&str, &Edge> = BTreeMap::new();
    let mut queue = std::collections::VecDeque::from([from]);
    while let Some(file) = queue.pop_front() {
        for (&next, &edge) in uses.get(file).into_iter().flatten() {
            if came_by.contains_key(next) {
                continue;
            }
            came_by.insert(next, edge);
            if next == to {
                let mut way = vec![edge];
                while way[way.len() - 1].from != from {
                    way.push(came_by[way[way.len() - 1].from.as_str()]);
                }
                way.reverse();
                return Some(way);
            }
            queue.push_back(next);
        }
    }
    None
}

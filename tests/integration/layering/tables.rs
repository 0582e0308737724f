//! The drawing of ARCHITECTURE.md as tables. Whoever moves a file edits these, and nothing else here.

/// What may use what.
pub(crate) struct Rules {
    /// What a module of the crate may use of it. `wasm` may use anything.
    pub layers: &'static [(&'static str, &'static [&'static str])],
    /// Folders with an order: their files and folders in groups, each of which may use its own group and the groups before.
    /// Other folders have none; circles are forbidden everywhere.
    pub orders: &'static [(&'static str, &'static [&'static [&'static str]])],
    /// Files that may use words of [`super::words::NOT_IN_THE_CORE`].
    pub platform: &'static [&'static str],
    /// Files that may keep something for a whole thread: the memory set aside, which changes no result.
    pub state: &'static [&'static str],
}

pub(crate) const RULES: Rules = Rules {
    layers: &[
        ("support", &["error"]),
        ("error", &[]),
        ("io", &["error", "support"]),
        ("mesh", &["error", "support"]),
        ("load", &["error", "io", "mesh"]),
        ("operators", &["error", "support", "mesh"]),
        ("field", &["error", "support", "mesh"]),
        ("solve", &["error", "support"]),
        ("smooth", &["error", "support", "mesh", "operators", "field", "solve"]),
        ("render", &["error", "support", "mesh", "field"]),
    ],
    orders: &[
        (
            "error",
            &[
                &["detail", "diagnostic", "interrupt", "stage"],
                &["parse", "mesh", "field", "solve", "smooth", "option"],
                &["mod"],
            ],
        ),
        (
            "io",
            &[
                &["formats", "mesh_data", "scan"],
                &["cursor"],
                &["assembly"],
                &["obj", "off", "ply", "vtk", "table"],
                &["columns", "write"],
                &["mod"],
            ],
        ),
        ("mesh", &[&["connectivity", "geometry"], &["topology", "validate"], &["mod"], &["shapes", "submesh", "weld"]]),
        ("operators", &[&["mod"], &["intrinsic"], &["laplacian", "mass"]]),
        ("solve", &[&["matrix", "lanes", "twofold"], &["vectors", "ordering"], &["direct"], &["iterative"], &["mod"]]),
        (
            "solve/ordering",
            &[
                &["ids", "permutation"],
                &["graph", "queue"],
                &["leaf", "refine"],
                &["edge_cut", "max_flow", "minimum_degree"],
                &["bisection"],
                &["dissection"],
                &["mod"],
            ],
        ),
        (
            "solve/direct",
            &[
                &["tree"],
                &["supernodes"],
                &["symbolic"],
                &["scalar"],
                &["lane_block"],
                &["numbers"],
                &["front"],
                &["multifrontal", "triangular"],
                &["cholesky"],
                &["mod"],
            ],
        ),
        (
            "solve/iterative",
            &[
                &["rows"],
                &["preconditioner"],
                &["cg", "nearby"],
                &["elimination", "aggregation"],
                &["multigrid"],
                &["squared"],
                &["mod"],
            ],
        ),
        (
            "field",
            &[
                &["arrays", "order", "sorting", "link"],
                &["scalar_field", "sweep"],
                &["critical", "steepest"],
                &["delta_hierarchy", "saddles", "level"],
                &["merging"],
                &["persistence"],
                &["features"],
                &["simplify"],
                &["morse"],
                &["mod"],
            ],
        ),
        (
            "smooth",
            &[
                &["options", "names"],
                &["choice", "prescribed"],
                &["active", "bounds", "data_term", "maximum_principle", "schedule"],
                &["operators"],
                &["missing"],
                &["channels"],
                &["input", "routes"],
                &["system"],
                &["systems"],
                &["constraints"],
                &["unconstrained"],
                &["report"],
                &["run"],
                &["methods"],
                &["prescribe"],
                &["method"],
                &["family"],
                &["mod"],
            ],
        ),
        (
            "smooth/prescribe",
            &[
                &["extrema"],
                &["options", "ranking"],
                &["representative", "steps"],
                &["prominence"],
                &["quadratic"],
                &["incidence"],
                &["dual", "interior"],
                &["procedure"],
                &["mod"],
            ],
        ),
        (
            "smooth/family",
            &[
                &["small", "traces"],
                &["block", "eigen"],
                &["pencil"],
                &["space"],
                &["estimate", "reach"],
                &["growth"],
                &["members"],
                &["noise"],
                &["choose"],
                &["curves", "lives", "options"],
                &["build"],
                &["mod"],
            ],
        ),
        (
            "render",
            &[
                &["colormap", "solids", "surface"],
                &["camera", "style"],
                &["options"],
                &["draw_list"],
                &["raster", "font", "ticks", "png"],
                &["text"],
                &["legend"],
                &["page"],
                &["scene", "mod"],
            ],
        ),
        ("wasm", &[&["shared"], &["core", "files", "snapshot"], &["mod"]]),
    ],
    platform: &["mesh/shapes.rs"],
    state: &["wasm/shared/reserve.rs"],
};

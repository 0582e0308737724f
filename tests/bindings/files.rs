//! Reading and writing files.

use js_sys::{Array, Float64Array, Object, Reflect, Uint8Array, Uint32Array};
use morse_smooth::wasm::{formats, read_field, read_mesh, read_table, write_mesh};
use wasm_bindgen::prelude::*;
use wasm_bindgen_test::wasm_bindgen_test;

use crate::support::{NONE, array, floats, get, ids, js, noise, thrown, torus};

#[wasm_bindgen_test]
fn files_go_round() {
    let mesh = torus();
    let positions = array(mesh.positions());
    let triangles = Uint32Array::from(mesh.connectivity().triangles().as_flattened());
    let f = noise(108);
    let fields = Object::new();
    Reflect::set(&fields, &JsValue::from_str("height"), &array(&f)).expect("an object");
    for format in ["'ply', binary: true", "'ply'", "'vtk', binary: true", "'vtk'"] {
        let options = js(&format!("{{ format: {format} }}"));
        Reflect::set(&options, &JsValue::from_str("fields"), &fields).expect("an object");
        let file = write_mesh(&positions, &triangles, &options).ok().expect("a file").unchecked_into();
        let back: JsValue = read_mesh(&file, &NONE).ok().expect("a mesh").into();
        assert_eq!(floats(&back, "positions"), mesh.positions(), "{format}");
        assert_eq!(ids(&back, "triangles"), mesh.connectivity().triangles().as_flattened(), "{format}");
        assert_eq!(floats(&get(&back, "fields"), "height"), f, "{format}");
        assert_eq!(Array::from(&get(&back, "warnings")).length(), 0, "{format}");
        assert!(get(&back, "vertexMap").is_null() && get(&back, "format").is_string());
    }
    let column = Uint8Array::from(&b"1.5\n-2\n3e1\n"[..]);
    assert_eq!(
        read_field(&column, &NONE).ok().expect("a column").unchecked_into::<Float64Array>().to_vec(),
        [1.5, -2.0, 30.0]
    );
    assert_eq!(thrown(read_mesh(&Uint8Array::new_with_length(0), &NONE)).0, "EmptyFile");
    assert_eq!(thrown(read_mesh(&column, &js("{ format: 'doc' }"))).0, "InvalidOption");
    assert_eq!(thrown(read_mesh(&column, &js("{ filename: 'a.ply' }"))).0, "UnknownOption");
    assert_eq!(thrown(write_mesh(&positions, &triangles, &NONE)).0, "InvalidOption");
    assert_eq!(
        thrown(write_mesh(&positions, &triangles, &js("{ format: 'ply', fields: { a: [1, 2] } }"))).0,
        "InvalidOption"
    );
    let short = js("{ format: 'ply', fields: { a: new Float64Array(3) } }");
    assert_eq!(thrown(write_mesh(&positions, &triangles, &short)).0, "LengthMismatch");
    assert_eq!(thrown(read_field(&column, &js("{ column: -1 }"))).0, "InvalidOption");
}

#[wasm_bindgen_test]
fn tables_have_columns_by_name() {
    let table = Uint8Array::from(&b"a,b,name\n1,2,x\n3,,y\n"[..]);
    let read: JsValue = read_table(&table, &NONE).ok().expect("a table").into();
    let columns = get(&read, "columns");
    assert_eq!(floats(&columns, "a"), [1.0, 3.0]);
    let missing = floats(&columns, "b");
    assert!(missing[0] == 2.0 && missing[1].is_nan());
    assert_eq!(Array::from(&get(&read, "warnings")).length(), 2);
    assert_eq!(thrown(read_table(&table, &js("{ column: 0 }"))).0, "UnknownOption");
}

#[wasm_bindgen_test]
fn formats_are_listed() {
    let first = formats().get(0);
    assert_eq!(get(&first, "name").as_string().as_deref(), Some("obj"));
    assert!(get(&first, "reads").is_truthy() && get(&first, "writes").is_truthy());
    assert_eq!(Array::from(&get(&first, "extensions")).length(), 1);
}

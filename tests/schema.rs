//! The published JSON schema of task files is the one that the program prints.

#[cfg(feature = "cli")]
#[test]
fn the_published_schema_is_up_to_date() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("specs/task.schema.json");
    let published = std::fs::read_to_string(path).unwrap();
    assert_eq!(published, ltl_rover::cli::schema::text(), "write it anew: ltl-rover schema > specs/task.schema.json");
}

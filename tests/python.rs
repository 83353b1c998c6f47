//! The example in Python reads what this crate writes, and its actor acts as ours does.

use ltl_rover::nn::fused::Fused;
use ltl_rover::nn::{ActorCritic, LayerNorm, NetworkShape, NetworkTensor, Record};
use ltl_rover::rng::{Purpose, Rng};
use std::path::Path;
use std::process::Command;

#[test]
fn python_reads_a_record_and_acts_by_it() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/read_checkpoint.py");
    let python = |arguments: &[&str]| Command::new("python3").arg(&script).args(arguments).output();
    if Command::new("python3").arg("--version").output().is_err() {
        println!("there is no python3 on this machine; nothing was compared");
        return;
    }
    let shape = NetworkShape { layer_norm: LayerNorm::Both, ..NetworkShape::new(3, 2, &[20, 17]) };
    let mut fused = Fused::new(&shape, &mut Rng::new(1, Purpose::Initialisation));
    let tensors =
        fused.tensors(true).into_iter().map(|tensor| NetworkTensor { name: format!("module.2.{}", tensor.name), ..tensor });
    let metadata = [("task_name".to_owned(), "a \"quoted\" ○ name\nin two lines".to_owned())].into();
    let bytes = Record { metadata, tensors: tensors.collect() }.to_bytes().unwrap();
    let folder = std::env::temp_dir().join(format!("ltl-rover-python-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("policy.safetensors");
    std::fs::write(&file, bytes).unwrap();
    let file = file.to_str().unwrap();

    let listed = python(&[file]).unwrap();
    let text = String::from_utf8_lossy(&listed.stdout).into_owned();
    assert!(listed.status.success() && text.contains("a \"quoted\" ○ name   … 2 lines"), "{text}");
    assert!(text.contains("module.2.critic.adam.m.2.weight") && text.contains("[17, 1]"), "{text}");

    let acted = python(&[file, "--module", "2", "--act", "0.5,-0.25,1"]).unwrap();
    let actions: Vec<f32> = serde_json::from_slice(&acted.stdout).unwrap();
    let mut ours = [0.0; 2];
    fused.act(&[0.5, -0.25, 1.0], &mut ours);
    std::fs::remove_dir_all(folder).unwrap();
    for (theirs, ours) in actions.iter().zip(ours) {
        assert!((theirs - ours).abs() < 1e-6, "{actions:?} {ours:?}");
    }
    assert_eq!(actions.len(), 2);
}

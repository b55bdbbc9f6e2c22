//! The digest of the scene on the machine that builds it.

use closeranks_bare_metal::{DIGEST, Scene, TICKS, digest};

fn main() {
    let mut scene = Scene::new().expect("the settings are accepted");
    let sum = (0..TICKS).fold(DIGEST, |sum, _| scene.tick().into_iter().fold(sum, digest));
    println!("digest {:016x}", digest(sum, scene.value()));
}

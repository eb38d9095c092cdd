//! Why a run stopped.

use tunnelproof::wire::StepError;

use crate::scenes::Scene;

/// Why a step was not done, and how the scene names what that speaks of by its number.
pub(super) fn said(error: &StepError, scene: &Scene) -> String {
    let (wires, bodies) = error.involved();
    let wires = wires
        .iter()
        .map(|wire| format!("wire {} is {:?}", wire.0, scene.wires[wire.0].name));
    let bodies = bodies
        .iter()
        .map(|body| format!("body {} is {:?}", body.0, scene.bodies[body.0].name));
    let named: Vec<String> = wires.chain(bodies).collect();
    if named.is_empty() {
        return error.to_string();
    }
    format!("{error} ({})", named.join(", "))
}

#[cfg(test)]
mod tests {
    use crate::scenes::Scene;
    use crate::simulate::Summary;

    #[test]
    fn what_stopped_a_run_has_the_name_that_the_scene_gives_it() {
        let text = "title = \"mixer\"\nduration = 0.1\n\
                    [[bodies]]\nname = \"bowl\"\nshape = \"plane\"\nposition = [0, 0, -1]\n\
                    [[bodies]]\nname = \"blade\"\nshape = { box = { half = [1, 0.1, 0.1] } }\nposition = [0, 0, 0]\n\
                    drive = { kinematic = [{ from = 0, angular_velocity = [0, 0, 1e5] }] }\n";
        let scene = Scene::from_toml(text).unwrap();
        let summary = Summary::of_guarded(&scene).unwrap();
        let stopped = summary.stopped.unwrap();
        assert!(stopped.starts_with("step 0: body 1 makes"), "{stopped}");
        assert!(stopped.ends_with("(body 1 is \"blade\")"), "{stopped}");
    }
}

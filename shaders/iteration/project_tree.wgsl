// Stage `project` with a BVH over the patches. CPU twin: `descend` of
// `src/iteration/project.rs`. It follows `tree.wgsl`.

// Every thread descends to its next leaf; then all threads project at once,
// which takes most of the time.
@compute @workgroup_size(WORKGROUP_SIZE)
fn project_tree(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let sample = sample_of(id, groups);
    if sample >= params.sample_count {
        return;
    }
    let point = samples[sample].xyz;
    var best = projected[sample];
    var descent: Descent;
    start_descent(&descent);
    loop {
        let leaf = next_leaf(&descent, point, best.distance_squared);
        if leaf == NO_NODE {
            break;
        }
        best = offer(best, leaf, point);
    }
    projected[sample] = best;
}

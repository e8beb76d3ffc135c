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
    var codes: array<u32, STACK_SIZE>;
    var distances: array<f32, STACK_SIZE>;
    var height = 0u;
    var code = nodes[0].code;
    loop {
        // Down to the nearest leaf.
        while (code & 1u) == 0u || (code == NO_NODE && height > 0u) {
            while code == NO_NODE && height > 0u {
                height--;
                if distances[height] < best.distance_squared {
                    code = codes[height];
                }
            }
            if (code & 1u) == 0u {
                let left = (code >> 1u) + 1u;
                let right = nodes[left - 1u].right_child;
                let left_distance = box_distance_squared(left, point);
                let right_distance = box_distance_squared(right, point);
                let right_is_nearer = right_distance < left_distance;
                let near = min(left_distance, right_distance);
                let far = max(left_distance, right_distance);
                let left_code = nodes[left].code;
                let right_code = nodes[right].code;
                code = select(
                    NO_NODE,
                    select(left_code, right_code, right_is_nearer),
                    near < best.distance_squared,
                );
                if far < best.distance_squared {
                    codes[height] = select(right_code, left_code, right_is_nearer);
                    distances[height] = far;
                    height++;
                }
            }
        }
        if code == NO_NODE {
            break;
        }
        best = offer(best, code >> 1u, point);
        code = NO_NODE;
    }
    projected[sample] = best;
}

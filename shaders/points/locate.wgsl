// Stage `locate`: the nearest foot of every point on one group of subpatches.
// Stage `bound_others`, once all groups were searched: lower bounds on the
// distances to the foot's patch and to all others. CPU twins, which take both
// from there: `closest_located` and `closest_beside` of
// `src/closest/branch_and_bound.rs`. One thread a point. It
// follows `tree.wgsl`, `newton.wgsl` and `bound.wgsl`.

struct LocateParams {
    // The points of the dispatch.
    first_point: u32,
    end_point: u32,
    // Number of subpatches in the groups before this one.
    patches_before: u32,
    iterations: u32,
    // What the distance to another patch may lack of that to the foot. Below 0,
    // patches slightly farther than the foot are bounded as well.
    permitted: f32,
}

struct Located {
    foot: Projected,
    // The patch that the foot's subpatch is part of.
    owner: u32,
    // The foot relative to the model's origin.
    point: array<f32, 3>,
    // Lower bounds on the squared distances to subpatches of the owner and to all
    // others, UNKNOWN_DISTANCE of none. Both together hold for all subpatches; those
    // of the owner that were passed over count among the others.
    own: f32,
    others: f32,
}

@group(0) @binding(0) var<uniform> params: LocateParams;
@group(0) @binding(1) var<storage, read> points: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read_write> located: array<Located>;
@group(0) @binding(3) var<storage, read> controls: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> centers: array<vec4<f32>>;
// The patch of each subpatch.
@group(0) @binding(6) var<storage, read> owners: array<u32>;

// The squared distance from which on a subpatch is passed over.
fn threshold(best: Located, is_bounding: bool) -> f32 {
    if !is_bounding {
        return best.foot.distance_squared;
    }
    let least = max(sqrt(best.foot.distance_squared) - params.permitted, 0.0);
    return least * least;
}

// The result with one subpatch more, whose foot may be nearer.
fn offer(best: Located, patch_index: u32, point: vec3<f32>) -> Located {
    var next = best;
    let local = point - centers[patch_index].xyz;
    let foot = iterate(patch_index * PATCH_SIZE, local, params.iterations, 0.0);
    if foot.distance_squared < best.foot.distance_squared {
        let packed = (params.patches_before + patch_index) | (foot.status << STATUS_SHIFT);
        next.foot = Projected(foot.distance_squared, packed, foot.parameters.x, foot.parameters.y);
        next.owner = owners[patch_index];
    }
    return next;
}

// The result with a bound on one subpatch more.
fn bounded(best: Located, patch_index: u32, point: vec3<f32>) -> Located {
    var next = best;
    let first = patch_index * PATCH_SIZE;
    let local = point - centers[patch_index].xyz;
    let towards = point - vec3<f32>(best.point[0], best.point[1], best.point[2]);
    var bound = bound_behind(first, local, towards);
    if bound < threshold(best, true) {
        let foot = iterate(first, local, params.iterations, 0.0);
        bound = max(bound, bound_about(first, local, foot.parameters));
    }
    if owners[patch_index] == best.owner {
        next.own = min(best.own, bound);
    } else {
        next.others = min(best.others, bound);
    }
    return next;
}

// The result with all subpatches of the group. Every thread descends to its next
// leaf; then all threads project at once, which takes most of the time. What is
// passed over lowers the bound on others.
fn descend(start: Located, point: vec3<f32>, is_bounding: bool) -> Located {
    var best = start;
    var limit = threshold(best, is_bounding);
    var descent: Descent;
    start_descent(&descent);
    loop {
        let leaf = next_leaf(&descent, point, limit);
        if leaf == NO_NODE {
            break;
        }
        if is_bounding {
            best = bounded(best, leaf, point);
        } else {
            best = offer(best, leaf, point);
            limit = threshold(best, false);
        }
    }
    // The limit of stage `bound_others` does not fall: all that waited was below it.
    best.others = min(best.others, descent.passed);
    return best;
}

fn point_index(id: vec3<u32>, groups: vec3<u32>) -> u32 {
    return params.first_point + id.x + id.y * groups.x * WORKGROUP_SIZE;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn locate(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = point_index(id, groups);
    if index >= params.end_point {
        return;
    }
    var start = located[index];
    if params.patches_before == 0u {
        start.foot.distance_squared = UNKNOWN_DISTANCE;
    }
    var best = descend(start, points[index].xyz, false);
    if best.foot.distance_squared < start.foot.distance_squared {
        let patch_index = (best.foot.patch_and_status & PATCH_MASK) - params.patches_before;
        let at = centers[patch_index].xyz
            + evaluate(patch_index * PATCH_SIZE, vec2<f32>(best.foot.s, best.foot.t));
        best.point = array<f32, 3>(at.x, at.y, at.z);
    }
    // Nothing is bounded yet.
    best.own = UNKNOWN_DISTANCE;
    best.others = UNKNOWN_DISTANCE;
    located[index] = best;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn bound_others(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = point_index(id, groups);
    if index >= params.end_point {
        return;
    }
    located[index] = descend(located[index], points[index].xyz, true);
}

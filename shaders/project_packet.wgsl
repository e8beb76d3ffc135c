// Stage `project` with a tree whose nodes have a child for every thread of a
// subgroup: its threads go through the tree together, each testing one child
// against the box around all their points. After what `src/gpu/kept_text.rs` writes.

// Children are ordered by keys: the bits of their squared distances from the
// threads' box, in whose lowest is their place among their siblings.
const TAKEN: u32 = 0xffffffffu;
const NOWHERE: u32 = 0xffffffffu;

// Deeper than any tree over the patches that fit a binding.
const STACK_SIZE: u32 = 32u;

// Turns of all loops that a subgroup may take, a projection's as often as its
// slowest thread does: llvmpipe ends every loop after 65,535.
const MAX_TURNS: u32 = 60000u;

// Two a child: the box's corners as bits, and of the first a place: of a leaf,
// twice its patch and one, else twice its own index.
@group(0) @binding(5) var<storage, read> nodes: array<vec4<u32>>;

fn gap(low: vec4<u32>, high: vec4<u32>, least: vec3<f32>, most: vec3<f32>) -> f32 {
    let outside = max(max(bitcast<vec3<f32>>(low.xyz) - most, least - bitcast<vec3<f32>>(high.xyz)), vec3<f32>(0.0));
    return dot(outside, outside) * BOX_ROUNDING;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn project_tree(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let sample = sample_of(id, groups);
    let exists = sample < params.sample_count;
    join();
    let point = samples[sample].xyz;
    var search = Search(best[sample], 0u);
    // A thread without a sample wants no patch.
    search.known.distance_squared = select(-1.0, search.known.distance_squared, exists);
    let outmost = vec3<f32>(FARTHEST);
    let most = largest3(select(-outmost, point, exists));
    let least = -largest3(select(-outmost, -point, exists));
    var reach = largest(search.known.distance_squared);
    // What is left of the children of the node in work, and of those above it.
    var keys = TAKEN;
    var parent = 0u;
    var keys_above: array<u32, STACK_SIZE>;
    var parents_above: array<u32, STACK_SIZE>;
    var height = 0u;
    var place = 0u;
    var own = 0.0;
    var pending = NOWHERE;
    loop {
        // On until a thread wants a second patch.
        loop {
            search.turns++;
            if search.turns > MAX_TURNS {
                // Not tried on everything: the distance may be too large, never too small.
                search.known.patch_and_status = (search.known.patch_and_status & PATCH_MASK)
                    | (ITERATION_LIMIT << STATUS_SHIFT);
                height = 0u;
                keys = TAKEN;
                place = NOWHERE;
                break;
            }
            if (place & 1u) == 0u {
                // Nothing is above the root.
                if place != 0u {
                    keys_above[height] = keys;
                    parents_above[height] = parent;
                    height++;
                }
                parent = place >> 1u;
                let child = parent * LANES + lane;
                let distance = gap(nodes[2u * child], nodes[2u * child + 1u], least, most);
                keys = (bitcast<u32>(distance) & ~(LANES - 1u)) | lane;
            } else if place != NOWHERE {
                let wanted = own < search.known.distance_squared;
                if any_of(wanted && pending != NOWHERE) {
                    break;
                }
                if any_of(wanted) {
                    take(place >> 1u, wanted);
                    pending = select(pending, place >> 1u, wanted);
                }
            }
            place = NOWHERE;
            loop {
                search.turns++;
                let nearest = least_of(keys);
                if !(bitcast<f32>(nearest) < reach) {
                    if height == 0u {
                        break;
                    }
                    height--;
                    keys = keys_above[height];
                    parent = parents_above[height];
                    continue;
                }
                keys = select(keys, TAKEN, keys == nearest);
                let child = parent * LANES + (nearest & (LANES - 1u));
                var corner = vec4<u32>(0u);
                if lane < 2u {
                    corner = nodes[2u * child + lane];
                }
                let low = subgroupBroadcast(corner, 0u);
                own = gap(low, subgroupBroadcast(corner, 1u), point, point);
                if any_of(own < search.known.distance_squared) {
                    place = low.w;
                    break;
                }
            }
            if place == NOWHERE {
                break;
            }
        }
        if !any_of(pending != NOWHERE) {
            break;
        }
        if pending != NOWHERE {
            search = offer(search, pending, point);
            pending = NOWHERE;
        }
        search.turns = u32(most_of(i32(search.turns)));
        reach = largest(search.known.distance_squared);
    }
    if exists {
        best[sample] = search.known;
    }
}

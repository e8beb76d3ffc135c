// Stage `pyramid`: the box of every node of a level, from those of its
// children, as `src/hierarchy/pyramid.rs`. One thread a node.

@group(0) @binding(0) var<uniform> params: StepParams;
@group(0) @binding(1) var<storage, read> nodes: array<Children>;
@group(0) @binding(2) var<storage, read> below: array<Box>;
@group(0) @binding(3) var<storage, read_write> above: array<Box>;

@compute @workgroup_size(WORKGROUP_SIZE)
fn pyramid(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let index = params.first + thread(id, groups);
    if index >= params.end {
        return;
    }
    let children = nodes[index];
    var whole = below[children.first];
    for (var k = 1u; k < children.count; k++) {
        let child = below[children.first + k];
        whole.low = min(whole.low, child.low);
        whole.high = max(whole.high, child.high);
    }
    above[index] = whole;
}

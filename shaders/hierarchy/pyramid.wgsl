// Stage `pyramid`: the box of every node of a level, from those of its
// children. CPU twin: `src/hierarchy/pyramid.rs`. One thread per node.

@group(0) @binding(0) var<uniform> params: StageParams;
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
    var enclosing = below[children.first];
    for (var k = 1u; k < children.count; k++) {
        let child = below[children.first + k];
        enclosing.low = min(enclosing.low, child.low);
        enclosing.high = max(enclosing.high, child.high);
    }
    above[index] = enclosing;
}

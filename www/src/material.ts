// What the models are made of: A of satin plastic, B of tinted glass.
import { DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial } from "three";

/** How much of glass is seen where it faces the viewer. */
const FACING = 0.28;
/** How much of it is seen where it is seen from the side. */
const GRAZING = 0.9;
/** How fast it grows towards the side. */
const POWER = 2.2;

/** An opaque material of this colour. */
export function satin(color: string): MeshPhysicalMaterial {
  return new MeshPhysicalMaterial({
    color,
    roughness: 0.45,
    metalness: 0,
    clearcoat: 0.3,
    clearcoatRoughness: 0.35,
    side: DoubleSide,
    // Edges lie on the surface, and shall be seen.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

/**
 * A dull material in the colours of its vertices, which no gloss shall change,
 * and no glass: it is drawn with the transparent, and after them.
 */
export function painted(): MeshStandardMaterial {
  return new MeshStandardMaterial({
    vertexColors: true,
    transparent: true,
    roughness: 0.9,
    metalness: 0,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
}

/**
 * A material of this colour that what lies behind is seen through, with clear
 * contours: more opaque the more it is seen from the side.
 */
export function glass(color: string): MeshPhysicalMaterial {
  const material = satin(color);
  material.transparent = true;
  material.depthWrite = false;
  // Where it coincides with satin it lies on top, not in speckles.
  material.polygonOffset = false;
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      `float facing = abs(dot(normalize(vViewPosition), normal));
      diffuseColor.a = mix(${FACING.toFixed(3)}, ${GRAZING.toFixed(3)}, pow(1.0 - facing, ${POWER.toFixed(3)}));
      #include <opaque_fragment>`,
    );
  };
  return material;
}

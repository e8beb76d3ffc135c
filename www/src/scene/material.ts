// The materials of the models: an opaque one, a glass-like one, and a painted one.
import { DoubleSide, MeshPhysicalMaterial, MeshStandardMaterial, type Texture } from "three";

/** The opacity of glass seen face on. */
const FACING = 0.28;
/** The opacity of glass seen at a grazing angle. */
const GRAZING = 0.9;
/** The exponent with which the opacity grows towards grazing angles. */
const POWER = 2.2;

/** Returns an opaque material of this colour. */
export function satin(color: string, offset = 1): MeshPhysicalMaterial {
  return new MeshPhysicalMaterial({
    color,
    roughness: 0.45,
    metalness: 0,
    clearcoat: 0.3,
    clearcoatRoughness: 0.35,
    side: DoubleSide,
    // Moves the surface back a little, because the outline lies on it.
    polygonOffset: true,
    polygonOffsetFactor: offset,
    polygonOffsetUnits: offset,
  });
}

/**
 * Returns a matt material in the colours of a scale. It is drawn among the
 * transparent objects and after them, so that neither gloss nor glass changes
 * the colours. The larger the offset is, the farther back it lies.
 */
export function painted(map: Texture, offset: number): MeshStandardMaterial {
  return new MeshStandardMaterial({
    map,
    transparent: true,
    roughness: 0.9,
    metalness: 0,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: offset,
    polygonOffsetUnits: offset,
  });
}

/**
 * Returns a transparent material of this colour whose opacity grows towards
 * grazing angles, which makes the contours clear.
 */
export function glass(color: string): MeshPhysicalMaterial {
  const material = satin(color);
  material.transparent = true;
  material.depthWrite = false;
  // Without an offset, glass is drawn over an opaque surface that coincides with it.
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

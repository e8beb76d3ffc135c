// The materials of the models: an opaque one, a glass-like one, a painted one, and points.
import {
  DoubleSide,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  type PointsMaterial,
  type Texture,
} from "three";

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

/** The brightness of a painted surface that is seen edge on, beside one that faces the eye: as in reports. */
const EDGE_ON = 0.65;
/** The exponent from brightness as it is displayed to that in which three.js computes. */
const GAMMA = 2.2;

/**
 * Returns a material in exactly the colours of a scale where it faces the eye, and little darker
 * elsewhere: no light changes what a colour means. It is drawn among the transparent objects and
 * after them, so that neither gloss nor glass does. The larger the offset is, the farther back it lies.
 */
export function painted(map: Texture, offset: number): MeshStandardMaterial {
  const material = new MeshStandardMaterial({
    map,
    toneMapped: false,
    transparent: true,
    roughness: 0.9,
    metalness: 0,
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: offset,
    polygonOffsetUnits: offset,
  });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      `float facing = abs(dot(isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition), normal));
      outgoingLight = diffuseColor.rgb * pow(mix(${EDGE_ON.toFixed(3)}, 1.0, facing), ${GAMMA.toFixed(3)});
      #include <opaque_fragment>`,
    );
  };
  return material;
}

/** The size of the points of a scan, in pixels. */
export const POINT_SIZE = 8;

/** The part of a point's radius beyond which it is dark, and how dark: it is seen on any ground. */
const RIM = { from: 0.7, brightness: 0.1 };
/**
 * How far back the rim of a point lies, in its radii: up to the arctangent of this, the angle at which a surface is
 * seen, points of a dense cloud hide each other's rims.
 */
const CONE = 2;

/**
 * Makes the points of a material round, with a dark rim. They are cones towards the eye, so that each pixel has the
 * colour of the point nearest to it, and rims are seen only where no other point is near.
 */
export function rounded(material: PointsMaterial): PointsMaterial {
  material.toneMapped = false;
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      `float away = 2.0 * length(gl_PointCoord - 0.5);
      if (away > 1.0) discard;
      outgoingLight *= away > ${RIM.from.toFixed(3)} ? ${RIM.brightness.toFixed(3)} : 1.0;
      bool isFlat = projectionMatrix[3][3] == 1.0;
      float depth = isFlat ? (projectionMatrix[3][2] + 1.0 - 2.0 * gl_FragCoord.z) / projectionMatrix[2][2] : 1.0 / gl_FragCoord.w;
      float radius = ${(POINT_SIZE / 2).toFixed(1)} * (isFlat ? 1.0 : depth) / (projectionMatrix[1][1] * scale);
      depth += ${CONE.toFixed(1)} * away * radius;
      float behind = (projectionMatrix[3][2] - projectionMatrix[2][2] * depth) / (isFlat ? 1.0 : depth);
      gl_FragDepth = 0.5 + 0.5 * behind;
      #include <opaque_fragment>`,
    );
    shader.fragmentShader = `uniform mat4 projectionMatrix;\nuniform float scale;\n${shader.fragmentShader}`;
  };
  return material;
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

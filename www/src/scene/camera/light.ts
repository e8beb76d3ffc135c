// The light of the scene: two lamps that move with the camera, and the sky.
import { AmbientLight, DirectionalLight, HemisphereLight, type Object3D, type Scene } from "three";

/** Adds the camera with its lamps, and the sky. */
export function light(scene: Scene, camera: Object3D): void {
  const [key, fill] = [new DirectionalLight(0xffffff, 2.6), new DirectionalLight(0xffffff, 0.7)];
  key.position.set(0.5, 0.8, 1);
  fill.position.set(-1, -0.4, 0.6);
  const sky = new HemisphereLight(0xffffff, 0x8d9399, 1.1);
  sky.position.set(0, 0, 1);
  camera.add(key, fill);
  scene.add(camera, sky, new AmbientLight(0xffffff, 0.2));
}

/** The walker, loaded once and cloned, as three.js's example of many skinned meshes does it. */
import { AnimationMixer, type Group } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { clone } from 'three/addons/utils/SkeletonUtils.js';

/** As the page places characters: in rows, metres apart. */
const IN_ROW = 8;
const BESIDE = 1.2;
const BEHIND = 1.5;

export async function addWalkers(content: Group, count: number): Promise<AnimationMixer[]> {
  const { scene, animations } = await new GLTFLoader().loadAsync('./walker.glb');
  return Array.from({ length: count }, (_, i) => {
    const walker = clone(scene);
    walker.position.set((i % IN_ROW) * BESIDE, 0, Math.floor(i / IN_ROW) * BEHIND);
    content.add(walker);
    const mixer = new AnimationMixer(walker);
    for (const animation of animations) mixer.clipAction(animation).play();
    return mixer;
  });
}

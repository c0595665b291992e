/** three.js alone, as its examples use it: a renderer, a mixer for each object, a frame whenever the browser asks. */
import { viewOf } from './scene.ts';
import { PeerStage } from './stage.ts';
import { addTentacle } from './tentacle-mesh.ts';
import { addWalkers } from './walkers.ts';

declare global {
  interface Window {
    /** Set once frames are drawn. */
    peerPlays?: boolean;
  }
}

const { scene, shadow, size } = viewOf(location.search);
const stage = new PeerStage(size, shadow);
const mixers =
  scene.kind === 'walkers'
    ? await addWalkers(stage.content, scene.count)
    : scene.kind === 'tentacle'
      ? [addTentacle(stage.content, scene.vertices)]
      : [];
stage.frameAll();

let last = performance.now();
function frame(now: number): void {
  requestAnimationFrame(frame);
  for (const mixer of mixers) mixer.update((now - last) / 1000);
  last = now;
  stage.draw();
  window.peerPlays = true;
}
requestAnimationFrame(frame);

/**
 * Uploads large buffers one per frame. three.js uploads all of a geometry's attributes in one task when it is first
 * drawn; but it tracks buffers by attribute, not geometry. So each attribute is first rendered alone, in a geometry
 * that draws nothing, and the real geometry then finds all of them uploaded.
 */
import {
  BufferGeometry,
  Camera,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  Scene,
  Sphere,
  type Texture,
  type WebGLRenderer,
  WebGLRenderTarget,
} from 'three';
import { nextFrame } from '../slices.ts';

/** Resolves when everything is on the GPU, or `signal` has aborted. */
export async function uploadInFrames(
  renderer: WebGLRenderer,
  geometry: BufferGeometry,
  textures: readonly Texture[],
  signal: AbortSignal,
  onProgress?: (done: number) => void,
): Promise<void> {
  const target = new WebGLRenderTarget(1, 1);
  const camera = new Camera();
  // Attributes are uploaded for everything in view, even with an invisible material; an index only when drawn.
  const unseen = new PointsMaterial({ visible: false });
  const drawn = new MeshBasicMaterial();
  const steps: (() => void)[] = Object.entries(geometry.attributes).map(([name, attribute]) => () => {
    const alone = new BufferGeometry();
    alone.setAttribute(name, attribute);
    render(renderer, new Points(alone, unseen), camera, target);
  });
  const { index } = geometry;
  if (index) {
    steps.push(() => {
      const alone = new BufferGeometry();
      alone.setIndex(index);
      alone.setDrawRange(0, 0);
      render(renderer, new Mesh(alone, drawn), camera, target);
    });
  }
  for (const texture of textures) steps.push(() => renderer.initTexture(texture));
  try {
    await renderer.compileAsync(new Mesh(new BufferGeometry(), drawn), camera);
    for (let i = 0; i < steps.length && !signal.aborted; i++) {
      steps[i]();
      onProgress?.((i + 1) / steps.length);
      await nextFrame();
    }
  } finally {
    // Not the geometries: that would free the uploaded buffers.
    target.dispose();
    unseen.dispose();
    drawn.dispose();
  }
}

function render(renderer: WebGLRenderer, object: Points | Mesh, camera: Camera, target: WebGLRenderTarget): void {
  object.frustumCulled = false;
  // Else three.js computes one, for sorting.
  object.geometry.boundingSphere = new Sphere();
  const scene = new Scene();
  scene.add(object);
  const before = renderer.getRenderTarget();
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  renderer.setRenderTarget(before);
}

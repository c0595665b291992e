/** What a heat map shows. */
import type { DataTexture, Mesh } from 'three';

/** The values of a mesh's material, one per vertex; undefined if it shows a joint's weights, or no heat at all. */
export function heatValuesOf(mesh: Mesh | undefined): DataTexture | undefined {
  const shader = { vertexShader: '', fragmentShader: '', uniforms: {} as { heatValues?: { value: DataTexture } } };
  // Only these three are used; the renderer has many more parameters.
  for (const material of [mesh?.material ?? []].flat()) material.onBeforeCompile(shader as never, {} as never);
  return shader.uniforms.heatValues?.value;
}

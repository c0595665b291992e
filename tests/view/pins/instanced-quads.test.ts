import { ShaderMaterial } from 'three';
import { expect, it } from 'vitest';
import { InstancedQuads } from '../../../src/view/pins/instanced-quads.ts';

const made = () => new InstancedQuads([-1, -1, 1, -1, -1, 1, 1, 1], { at: 3, size: 1 }, new ShaderMaterial(), 40);

it('keeps what was written while it takes more room, and gives it to the shader', () => {
  const quads = made();
  for (let n = 0; n < 100; n++) {
    const i = quads.add();
    expect(i).toBe(n);
    quads.numbers.at.set([n, 2 * n, 3 * n], 3 * i);
    quads.numbers.size[i] = n + 0.5;
  }
  quads.filled();
  const { geometry } = quads.mesh;
  expect(geometry.instanceCount).toBe(100);
  expect(quads.mesh.visible).toBe(true);
  for (const n of [0, 15, 16, 99]) {
    expect([geometry.attributes.at.getX(n), geometry.attributes.at.getZ(n)]).toEqual([n, 3 * n]);
    expect(geometry.attributes.size.getX(n)).toBe(n + 0.5);
  }
  expect(geometry.attributes.size.array).toBe(quads.numbers.size);
});

it('is not drawn while there are none, and takes no more room for as many as before', () => {
  const quads = made();
  quads.filled();
  expect(quads.mesh.visible).toBe(false);
  for (let n = 0; n < 20; n++) quads.add();
  const { at } = quads.numbers;
  quads.clear();
  for (let n = 0; n < 20; n++) quads.add();
  quads.filled();
  expect(quads.numbers.at).toBe(at);
  expect(quads.mesh.geometry.instanceCount).toBe(20);
});

import { expect, it } from 'vitest';
import { changeText, grownPast, type PageResources } from './page-resources.ts';

const BEFORE: PageResources = {
  heapBytes: 4_000_000,
  codeBytes: 9_000_000,
  nodes: 900,
  listeners: 100,
  geometries: 6,
  textures: 5,
  gpuObjects: 50,
  objectUrls: 0,
  observers: 18,
};
const AFTER: PageResources = { ...BEFORE, heapBytes: 4_200_000, codeBytes: 12_000_000, nodes: 895 };

it('tells what a page holds more of than it may after so many rounds', () => {
  expect(grownPast({ heapBytes: 30_000, nodes: 5 }, BEFORE, AFTER, 5)).toEqual([
    'heapBytes grew from 4000000 to 4200000: it may by 30000, 5 times',
  ]);
});

it('lets a page grow by just what it may, and by anything that has no limit', () => {
  expect(grownPast({ heapBytes: 40_000 }, BEFORE, AFTER, 5)).toEqual([]);
  expect(grownPast({ heapBytes: 200_000, nodes: 0 }, BEFORE, AFTER)).toEqual([]);
});

it('tells only what differs in what a page holds, bytes in megabytes', () => {
  expect(changeText(BEFORE, AFTER)).toBe('heapBytes 4.00 MB → 4.20 MB, codeBytes 9.00 MB → 12.00 MB, nodes 900 → 895');
  expect(changeText(BEFORE, BEFORE)).toBe('all level');
});

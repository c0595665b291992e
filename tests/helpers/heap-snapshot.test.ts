/** Parts of a snapshot as V8 writes it: five nodes, of which two are V8's own and one is the browser's. */
import { expect, it } from 'vitest';
import { heapBytesIn } from './heap-snapshot.ts';

const FIELDS = ['type', 'name', 'id', 'self_size', 'edge_count', 'detachedness'];
const TYPES = ['hidden', 'array', 'string', 'object', 'code', 'native', 'object shape'];
const STRINGS = ['Object', '(code)', 'system / JSArrayBufferData', 'Text'];
const node = (type: string, name: string, bytes: number) => [
  TYPES.indexOf(type),
  STRINGS.indexOf(name),
  1,
  bytes,
  0,
  0,
];
const snapshot = (...nodes: readonly number[][]) =>
  JSON.stringify({
    snapshot: { meta: { node_fields: FIELDS, node_types: [TYPES] } },
    nodes: nodes.flat(),
    strings: STRINGS,
  });

it('counts objects and the memory of typed arrays of a heap snapshot apart from compiled code, and no elements of the page', () => {
  const json = snapshot(
    node('object', 'Object', 28),
    node('native', 'system / JSArrayBufferData', 800),
    node('native', 'Text', 96),
    node('code', '(code)', 4000),
    node('object shape', 'Object', 40),
  );
  expect(heapBytesIn(json)).toEqual({ heapBytes: 828, codeBytes: 4040 });
});

it('refuses a heap snapshot of a format that it does not know', () => {
  const json = snapshot(node('native', 'Text', 96));
  expect(() => heapBytesIn(json)).toThrow('The heap snapshot has fields type name id');
});

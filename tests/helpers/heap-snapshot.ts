/** What a heap snapshot of V8 consists of, which tells what scripts keep from what V8 makes of the scripts themselves. */

export interface HeapBytes {
  /** Objects, lists, closures, strings, and the memory of typed arrays. */
  readonly heapBytes: number;
  /**
   * Compiled code, and what V8 knows about types for it. It grows for as long as functions become hot: each is compiled
   * once more, up to three times, with what it calls within it.
   */
  readonly codeBytes: number;
}

/** Types of nodes that are V8's own. */
const OF_CODE: ReadonlySet<string> = new Set(['code', 'hidden', 'object shape', 'synthetic']);
/** The memory of a typed array is the browser's, like elements and styles, which are counted as such. */
const OF_ARRAYS = 'system / JSArrayBufferData';

/** The parts of a snapshot's JSON that are read here. */
interface Snapshot {
  readonly snapshot: {
    readonly meta: {
      readonly node_fields: readonly string[];
      /** Of the first field: the names of types. */
      readonly node_types: readonly (readonly string[])[];
    };
  };
  /** As many numbers for each node as there are fields. */
  readonly nodes: readonly number[];
  readonly strings: readonly string[];
}

/** @param json as `HeapProfiler.takeHeapSnapshot` gives it */
export function heapBytesIn(json: string): HeapBytes {
  // The format of V8 ("heapsnapshot"), which has not changed in years; the check is below.
  const { snapshot, nodes, strings } = JSON.parse(json) as Snapshot;
  const { node_fields: fields, node_types: types } = snapshot.meta;
  const [type, name, size] = ['type', 'name', 'self_size'].map((field) => fields.indexOf(field));
  const names = types[type];
  let [heapBytes, codeBytes] = [0, 0];
  for (let at = 0; at < nodes.length; at += fields.length) {
    const kind = names[nodes[at + type]];
    const bytes = nodes[at + size];
    if (OF_CODE.has(kind)) codeBytes += bytes;
    else if (kind !== 'native' || strings[nodes[at + name]] === OF_ARRAYS) heapBytes += bytes;
  }
  if (!(heapBytes > 0 && codeBytes > 0)) throw new Error(`The heap snapshot has fields ${fields.join(' ')}.`);
  return { heapBytes, codeBytes };
}

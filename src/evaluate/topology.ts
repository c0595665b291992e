/**
 * The edges of a mesh, each once, for drawing it as wire.
 *
 * The triangles' sides are sorted into buckets by their lower vertex (counted, then filled); within a bucket, each upper
 * vertex is marked as seen. Linear in the triangles, also where thousands meet at one vertex, and a few large arrays
 * instead of a hash of pairs.
 */

/** Two vertex indices an edge, the lower one first, for a line index. Edges of a vertex to itself are left out. */
export function edgesOf(triangles: Uint32Array, vertexCount: number): Uint32Array {
  const corners = triangles.length - (triangles.length % 3);
  /** First where the bucket of each lower vertex begins; after filling, where it ends. */
  const bucket = new Uint32Array(vertexCount + 1);
  for (let t = 0; t < corners; t += 3) {
    let a = triangles[t + 2];
    for (let i = t; i < t + 3; i++) {
      const b = triangles[i];
      if (a !== b) bucket[(a < b ? a : b) + 1]++;
      a = b;
    }
  }
  for (let v = 0; v < vertexCount; v++) bucket[v + 1] += bucket[v];

  const upper = new Uint32Array(bucket[vertexCount]);
  for (let t = 0; t < corners; t += 3) {
    let a = triangles[t + 2];
    for (let i = t; i < t + 3; i++) {
      const b = triangles[i];
      if (a !== b) upper[bucket[a < b ? a : b]++] = a < b ? b : a;
      a = b;
    }
  }

  /** The lower vertex, plus 1, that each vertex was last an upper one of. */
  const seen = new Uint32Array(vertexCount);
  const edges = new Uint32Array(2 * upper.length);
  let o = 0;
  for (let v = 0, at = 0; v < vertexCount; v++) {
    for (; at < bucket[v]; at++) {
      const high = upper[at];
      if (seen[high] === v + 1) continue;
      seen[high] = v + 1;
      edges[o++] = v;
      edges[o++] = high;
    }
  }
  return edges.slice(0, o);
}

/**
 * Deforms a single vertex exactly as in the whole skin, by evaluating a skin of only this vertex instead of deforming
 * up to a million to read one.
 */
import type { Morph, MorphRows } from '../../model/morph.ts';
import { oneSurface, type Skin } from '../../model/skin.ts';
import { blendMorphs, compileSkin, deform } from './deform.ts';

/** A deformed vertex, in the character's space. */
export interface OneVertex {
  /** x y z. */
  readonly position: Float64Array;
  /**
   * x y z, normalised. Undefined if the file has no normals, since those are computed from all surrounding triangles.
   */
  readonly normal: Float64Array | undefined;
}

/**
 * Makes a function that deforms one vertex repeatedly.
 * @returns takes the character's DOFs, of which the morph weights are the last, and the joints' world matrices, 16 each
 * (undefined without a skeleton); returns arrays that the next call overwrites
 */
export function vertexDeformer(
  skin: Skin,
  morphs: readonly Morph[],
  vertex: number,
): (dofs: Float64Array, world: Float64Array | undefined) => OneVertex {
  const compiled = compileSkin(skinOfOne(skin, vertex));
  const own = morphs.map((m) => ({
    name: m.name,
    positions: rowsOfOne(m.positions, vertex),
    normals: rowsOfOne(m.normals, vertex),
  }));
  const blended = { position: new Float64Array(3), normal: new Float64Array(3) };
  const position = new Float64Array(3);
  const normal = new Float64Array(3);
  return (dofs, world) => {
    blendMorphs(compiled, own, dofs, dofs.length - morphs.length, blended.position, blended.normal);
    deform(compiled, world, blended.position, blended.normal, position, normal);
    return { position, normal: skin.normals ? normal : undefined };
  };
}

function skinOfOne(skin: Skin, vertex: number): Skin {
  const { name, positions, normals, attachments, bindings } = skin;
  const own = (column: Float64Array) => column.slice(3 * vertex, 3 * vertex + 3);
  const from = attachments?.start[vertex] ?? 0;
  const to = attachments?.start[vertex + 1] ?? 0;
  return {
    name,
    positions: own(positions),
    // With any normal given, none is computed from the triangles, which are missing here.
    normals: normals ? own(normals) : Float64Array.of(0, 1, 0),
    triangles: new Uint32Array(0),
    surfaces: oneSurface(new Uint32Array(0)),
    bindings,
    ...(attachments && {
      attachments: {
        start: Uint32Array.of(0, to - from),
        joints: attachments.joints.slice(from, to),
        weights: attachments.weights.slice(from, to),
      },
    }),
  };
}

/** All of its rows, since a file may list a vertex twice. */
function rowsOfOne({ indices, values }: MorphRows, vertex: number): MorphRows {
  const rows: number[] = [];
  for (let row = indices.indexOf(vertex); row >= 0; row = indices.indexOf(vertex, row + 1)) {
    rows.push(values[3 * row], values[3 * row + 1], values[3 * row + 2]);
  }
  return { indices: new Uint32Array(rows.length / 3), values: Float64Array.from(rows) };
}

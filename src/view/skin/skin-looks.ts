/** What the surfaces of a skin look like in the style `textured`: those of one look are drawn with one material. */
import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import type { Skin } from '../../model/skin.ts';

/** Without texture and colour: as in the style `solid`. */
export interface SkinLook {
  /** As in the material. */
  readonly texture?: string;
  /** Linear, each from 0 to 1. */
  readonly color?: Vec3;
}

export interface SkinLooks {
  /** All different; at least one. */
  readonly looks: readonly SkinLook[];
  /** Successive triangles of one look, in order. */
  readonly runs: readonly LookRun[];
}

interface LookRun {
  /** Index in `looks`. */
  readonly look: number;
  readonly triangleStart: number;
  triangleCount: number;
}

/** Cached. */
export const looksOf = perObject(({ surfaces, texcoords }: Skin): SkinLooks => {
  const looks = new Map<string, { readonly index: number; readonly look: SkinLook }>();
  const runs: LookRun[] = [];
  for (const { material, triangleStart, triangleCount } of surfaces) {
    const texture = texcoords && material?.texture;
    const color = material?.color && inRange(material.color);
    const key = JSON.stringify([texture, color]);
    const known = looks.get(key);
    const index = known?.index ?? looks.size;
    if (!known) looks.set(key, { index, look: { ...(texture !== undefined && { texture }), ...(color && { color }) } });
    const last = runs.at(-1);
    if (last?.look === index) last.triangleCount += triangleCount;
    else runs.push({ look: index, triangleStart, triangleCount });
  }
  return { looks: [...looks.values()].map(({ look }) => look), runs };
});

function inRange([r, g, b]: Vec3): Vec3 {
  const clamp = (c: number) => Math.min(1, Math.max(0, c));
  return [clamp(r), clamp(g), clamp(b)];
}

/**
 * Left and right in names, and names without them:
 *
 *     hip_03_r, LeftUpLeg, L_Arm, arm.L, lShldr      the side is a separate word
 *     lfemur, legR                                   attached: a side only if its counterpart exists too
 *
 * Retargeting parses names for parts of the body (`evaluate/retarget/names.ts`); here any two names that differ only in
 * their side are counterparts, whatever they mean.
 */

/** The side that a name states. */
export type Side = 'left' | 'right';

/** One reading of a name. */
export interface SidedName {
  readonly side: Side;
  /** The same for the name of the other side. */
  readonly key: string;
}

const SIDES: Readonly<Record<string, Side>> = {
  left: 'left',
  l: 'left',
  lft: 'left',
  right: 'right',
  r: 'right',
  rgt: 'right',
};

/** The side given by a word of the name; undefined if there is none, or both. */
export function sidedName(name: string): SidedName | undefined {
  const tokens = tokensOf(name);
  const sides = new Set(tokens.flatMap((token) => SIDES[token] ?? []));
  // A name with both sides is ambiguous.
  if (sides.size !== 1 || tokens.length === 0) return undefined;
  const [side] = sides;
  return { side, key: tokens.map((token) => (SIDES[token] ? '*' : token)).join(' ') };
}

/** Sides attached to the beginning or end of a name; they may not be sides at all. */
function gluedSides(name: string): readonly SidedName[] {
  const word = tokensOf(name).join(' ');
  const found: SidedName[] = [];
  const begins = /^(left|right|l|r)(.+)$/.exec(word);
  if (begins) found.push({ side: SIDES[begins[1]], key: `*+ ${begins[2]}` });
  const ends = /^(.+?)(left|right|l|r)$/.exec(word);
  if (ends) found.push({ side: SIDES[ends[2]], key: `${ends[1]} +*` });
  return found;
}

/** The side of a name, by a separate or attached word. */
export function sideOf(name: string): Side | undefined {
  return (sidedName(name) ?? gluedSides(name)[0])?.side;
}

/** A name without case and separators, to compare names. */
export function plainName(name: string): string {
  return tokensOf(name).join(' ');
}

/**
 * Pairs names of opposite sides: the index of each one's partner, -1 for none. Of several with the same name, the first
 * ones are paired, then the second ones.
 */
export function partnersByName(names: readonly string[]): Int32Array {
  const partner = new Int32Array(names.length).fill(-1);
  const pair = (readings: (name: string) => readonly SidedName[]) => {
    const waiting = new Map<string, number[]>();
    names.forEach((name, i) => {
      if (partner[i] >= 0) return;
      for (const { side, key } of readings(name)) {
        const other = waiting.get(`${side === 'left' ? 'right' : 'left'} ${key}`);
        const found = other?.find((o) => partner[o] < 0);
        if (found !== undefined) {
          partner[i] = found;
          partner[found] = i;
          return;
        }
        const own = `${side} ${key}`;
        const list = waiting.get(own);
        if (list) list.push(i);
        else waiting.set(own, [i]);
      }
    });
  };
  pair((name) => asList(sidedName(name)));
  pair((name) => (sidedName(name) ? NONE : gluedSides(name)));
  return partner;
}

const NONE: readonly SidedName[] = [];

function asList(reading: SidedName | undefined): readonly SidedName[] {
  return reading ? [reading] : NONE;
}

/** `mixamorig:LeftUpLeg` → left up leg; `LHipJoint` → l hip joint; `toe1-1.R` → toe 1 1 r. */
function tokensOf(name: string): string[] {
  return name
    .slice(name.lastIndexOf(':') + 1)
    .replace(/([a-z\d])([A-Z])/g, '$1 $2')
    .replace(/(?<=[A-Z])(?=[A-Z][a-z])/g, ' ')
    .replace(/([A-Za-z])(\d)/g, '$1 $2')
    .replace(/(\d)([A-Za-z])/g, '$1 $2')
    .toLowerCase()
    .split(/[^\p{L}\d]+/u)
    .filter(Boolean);
}

/**
 * Left and right in names, and what a name is without them:
 *
 *     hip_03_r, LeftUpLeg, L_Arm, arm.L, lShldr      a word of its own says the side
 *     lfemur, legR                                   glued to another: a side only where its counterpart is there too
 *
 * Retargeting reads names for what part of a body they mean (`evaluate/retarget/names.ts`); here any two names that differ
 * by nothing but their sides are each other's, whatever they mean.
 */

export type Side = 'left' | 'right';

/** One way to read a name. */
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

/** The side that a word of the name says; undefined where none does, or both are said. */
export function sidedName(name: string): SidedName | undefined {
  const tokens = tokensOf(name);
  const sides = new Set(tokens.flatMap((token) => SIDES[token] ?? []));
  // Of a name that says both, nothing is known.
  if (sides.size !== 1 || tokens.length === 0) return undefined;
  const [side] = sides;
  return { side, key: tokens.map((token) => (SIDES[token] ? '*' : token)).join(' ') };
}

/** Sides glued to the beginning or the end of a name: they may be no sides at all. */
function gluedSides(name: string): readonly SidedName[] {
  const word = tokensOf(name).join(' ');
  const found: SidedName[] = [];
  const begins = /^(left|right|l|r)(.+)$/.exec(word);
  if (begins) found.push({ side: SIDES[begins[1]], key: `*+ ${begins[2]}` });
  const ends = /^(.+?)(left|right|l|r)$/.exec(word);
  if (ends) found.push({ side: SIDES[ends[2]], key: `${ends[1]} +*` });
  return found;
}

/** The side that a name says, by a word of its own or by one glued to another. */
export function sideOf(name: string): Side | undefined {
  return (sidedName(name) ?? gluedSides(name)[0])?.side;
}

/** A name without case and whatever separates its words: for joints that are called the same. */
export function plainName(name: string): string {
  return tokensOf(name).join(' ');
}

/**
 * Which name is which other one's for the opposite side: the index of each one's partner, -1 for those without. Of
 * several with one name the first ones go together, then the second ones.
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
    .replace(/([A-Z]+)([A-Z][a-z])/g, '$1 $2')
    .replace(/([A-Za-z])(\d)/g, '$1 $2')
    .replace(/(\d)([A-Za-z])/g, '$1 $2')
    .toLowerCase()
    .split(/[^\p{L}\d]+/u)
    .filter(Boolean);
}

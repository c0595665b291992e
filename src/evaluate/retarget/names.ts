/**
 * Parses joint names: a side, a part of the body, a number.
 *
 *     mixamorig:LeftUpLeg  →  left thigh        lShldr  →  left arm         chest          →  spine
 *     upper_arm_l          →  left arm          lfemur  →  left thigh       RIGHT_KNEE     →  right shin
 *     upperleg01.R         →  right thigh 1     LeftHandThumb2  →  left thumb 2
 *
 * Some words are ambiguous: a `shoulder` is a collar bone if there is an arm below, else the arm; a `leg` is the lower
 * one if there is a thigh. `roles.ts` decides from the context.
 */

/** The side that a joint's name states; `middle` if it states none. */
export type NameSide = 'left' | 'right' | 'middle';

/** The meaning of a word. `shoulder`, `sidedHip` and `leg` are ambiguous. */
export type Word =
  | 'hips'
  | 'spine'
  | 'neck'
  | 'head'
  | 'collar'
  | 'shoulder'
  | 'arm'
  | 'forearm'
  | 'hand'
  | 'sidedHip'
  | 'thigh'
  | 'leg'
  | 'shin'
  | 'foot'
  | 'toe'
  | 'thumb'
  | 'index'
  | 'middle'
  | 'ring'
  | 'pinky';

/** A joint's name in parts. */
export interface NameParts {
  readonly side: NameSide;
  readonly word: Word | undefined;
  /** 0 for none. */
  readonly number: number;
  /** The rest, without prefixes, sides and separators; compared to find equal names. */
  readonly plain: string;
}

const WORDS: Readonly<Record<Word, string>> = {
  hips: 'hips hip pelvis root',
  spine:
    'spine chest torso abdomen ab abs belly waist back lowerback upperback lowerspine upperspine upperchest midspine ' +
    'thorax lowertorso uppertorso stomach',
  neck: 'neck lowerneck upperneck neckdummy cervical',
  head: 'head skull',
  collar: 'collar clavicle collarbone scapula',
  shoulder: 'shoulder',
  arm: 'arm upperarm uparm shldr humerus bicep',
  forearm: 'forearm lowerarm lowarm elbow radius ulna',
  hand: 'hand wrist palm',
  sidedHip: '',
  thigh: 'thigh upleg upperleg femur uplegs',
  leg: 'leg',
  shin: 'shin lowleg lowerleg calf knee tibia',
  foot: 'foot ankle feet',
  toe: 'toe toes toebase ball metatarsal',
  thumb: 'thumb',
  index: 'index indexfinger',
  middle: 'mid middle middlefinger',
  ring: 'ring ringfinger',
  pinky: 'pinky little pinkyfinger littlefinger',
};

const MEANING: ReadonlyMap<string, Word> = new Map(
  // The keys of a record of words are words.
  (Object.entries(WORDS) as [Word, string][]).flatMap(([word, list]) =>
    list
      .split(' ')
      .filter(Boolean)
      .map((spelling) => [spelling, word] as const),
  ),
);

/** Prefixes and suffixes without meaning that programs add to names. */
const NOISE = new Set(['joint', 'jnt', 'bone', 'bip', 'bip01', 'b', 'def', 'character', 'ctrl', 'skel', 'mixamorig']);
/** Ends of bones, and attachments that are no part of the body. */
const NOT_A_PART = /end$|nub|site|eye|jaw|hair|buttock|twist|tongue|^finger/;
const FINGER = /thumb|index|mid(?:dle)?|ring|pinky|little/;

/** Parses a joint's name. Prefixes up to a colon and a suffix from `#` are ignored, as is case. */
export function readName(name: string): NameParts {
  const own = name.slice(name.lastIndexOf(':') + 1).split('#', 1)[0];
  const tokens = tokensOf(own);
  let side: NameSide = 'middle';
  let number = 0;
  const words: string[] = [];
  tokens.forEach((token) => {
    if (/^\d+$/.test(token)) number = number * 10 + Number(token.slice(0, 4));
    else if (token === 'left' || token === 'l') side = 'left';
    else if (token === 'right' || token === 'r') side = 'right';
    else if (!NOISE.has(token)) words.push(token);
  });
  let key = words.join('');
  if (side === 'middle') {
    const glued = /^(left|right|l|r)(.+)$/.exec(key);
    if (glued && MEANING.has(glued[2])) {
      side = glued[1].startsWith('l') ? 'left' : 'right';
      key = glued[2];
    }
  }
  const plain = `${side} ${key} ${number || ''}`.trim();
  // `LHipJoint` is a stub above the thigh; without a thigh it is the thigh itself.
  return { side, word: wordOf(key, side), number, plain };
}

function wordOf(key: string, side: NameSide): Word | undefined {
  if (NOT_A_PART.test(key)) return undefined;
  // `RightHandIndex2`, `LeftInHandRing`
  const finger = side === 'middle' ? undefined : FINGER.exec(key);
  if (finger) return MEANING.get(finger[0]);
  const word = MEANING.get(key);
  if (word !== 'hips' || side === 'middle') return word;
  return key === 'hip' ? 'sidedHip' : undefined;
}

/** `LHipJoint` → l hip joint; `upper_arm_l` → upper arm l; `toe1-1.R` → toe 1 1 r. */
function tokensOf(name: string): string[] {
  return name
    .replace(/([a-z\d])([A-Z])/g, '$1 $2')
    .replace(/(?<=[A-Z])(?=[A-Z][a-z])/g, ' ')
    .replace(/([A-Za-z])(\d)/g, '$1 $2')
    .replace(/(\d)([A-Za-z])/g, '$1 $2')
    .toLowerCase()
    .split(/[^a-z\d]+/)
    .filter(Boolean);
}

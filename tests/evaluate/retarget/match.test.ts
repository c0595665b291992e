import { readdirSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { WALKER_SKELETON } from '../../../examples/characters/walker/skeleton.ts';
import { automaticPairs } from '../../../src/evaluate/retarget/match.ts';
import { readName } from '../../../src/evaluate/retarget/names.ts';
import { guessSpace } from '../../../src/evaluate/space/space-guess.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { describeShared, hasShared, sharedBytes, sharedPath } from '../../helpers/shared.ts';
import { PARTS, person } from './people.ts';

describe('a joint’s name', () => {
  it.each([
    ['mixamorig:LeftUpLeg', 'left', 'thigh'],
    ['lShldr', 'left', 'arm'],
    ['rfemur', 'right', 'thigh'],
    ['upper_arm_l', 'left', 'arm'],
    ['LEFT_SHOULDER#', 'left', 'shoulder'],
    ['lowerleg01.R', 'right', 'shin'],
    ['RightHandThumb2', 'right', 'thumb'],
    ['LeftInHandIndex', 'left', 'index'],
    ['Spine1', 'middle', 'spine'],
    ['joint_Root', 'middle', 'hips'],
    ['LeftHip', 'left', 'sidedHip'],
    ['LHipJoint', 'left', 'sidedHip'],
    ['hip', 'middle', 'hips'],
  ])('%s is of the %s side, and a %s', (name, side, word) => {
    expect(readName(name)).toMatchObject({ side, word });
  });

  it.each(['rButtock', 'LeftForeArmEnd', 'leftEye', 'figureHair', 'tail_1', '', 'joint7'])(
    '%j is no part of a body by itself',
    (name) => {
      expect(readName(name).word).toBeUndefined();
    },
  );
});

/** Pairs as words: `left shin ← LeftLeg`. */
function named(source: Skeleton, target: Skeleton): Record<string, string> {
  const pairs = automaticPairs(source, target);
  return Object.fromEntries(pairs.map((p) => [target.joints[p.target].name, source.joints[p.source].name]));
}

describe('matching', () => {
  it('what is degenerate is refused as a pin, and as a target of an existing one', () => {
    const source = person({ names: (part) => part.split(' ').map(capital).join('') });
    const target = person({ names: (part) => `rig:${part.replace('left ', 'l_').replace('right ', 'r_')}` });
    const pairs = automaticPairs(source, target);
    expect(pairs.map((p) => p.source)).toEqual([...PARTS.keys()]);
    expect(pairs.map((p) => p.target)).toEqual([...PARTS.keys()]);
  });

  it('knows left from right by the shape of a body without names', () => {
    const nameless = person({ names: () => '' });
    const pairs = automaticPairs(person(), nameless);
    const found = new Map(pairs.map((p) => [PARTS[p.target], PARTS[p.source]]));
    const limbs = PARTS.filter((part) => /thigh|shin|foot|forearm| arm|hand|hips/.test(part));
    for (const part of limbs) expect([part, found.get(part)]).toEqual([part, part]);
    expect(Math.max(...pairs.map((p) => p.confidence))).toBeLessThan(0.6);
  });

  it('puts a trunk of two onto one of four in proportion, each end onto its end', () => {
    const chain = (...names: string[]): Skeleton => ({
      name: 'chain',
      joints: names.map((name, i) => ({ ...person().joints[1], name, parent: i - 1 })),
    });
    expect(
      named(chain('Hips', 'Spine', 'Spine1', 'Spine2', 'Spine3', 'Head'), chain('hip', 'abdomen', 'chest', 'head')),
    ).toEqual({ hip: 'Hips', abdomen: 'Spine', chest: 'Spine3', head: 'Head' });
  });

  it('pairs no joint of the target twice', () => {
    const pairs = automaticPairs(person(), WALKER_SKELETON);
    expect(new Set(pairs.map((p) => p.target)).size).toBe(pairs.length);
  });
});

const capital = (word: string) => word[0].toUpperCase() + word.slice(1);

/** The joints without which nothing moves as it should, on the walker, and what they have to follow in each file. */
const ESSENTIAL: Readonly<Record<string, readonly string[]>> = {
  //                              hips      shin_l        foot_r       forearm_l     hand_r       head
  'bandai-namco-bow-normal.bvh': ['Hips', 'LowerLeg_L', 'Foot_R', 'LowerArm_L', 'Hand_R', 'Head'],
  'boxing-extra-line.bvh': ['Hips', 'LeftKnee', 'RightAnkle', 'LeftElbow', 'RightWrist', 'Head'],
  'cmu-01_01.bvh': ['Hips', 'LeftLeg', 'RightFoot', 'LeftForeArm', 'RightHand', 'Head'],
  'cmu-daz-pirouette.bvh': ['hip', 'lShin', 'rFoot', 'lForeArm', 'rHand', 'head'],
  'geno-stance.bvh': ['Hips', 'LeftLeg', 'RightFoot', 'LeftForeArm', 'RightHand', 'Head'],
  'lafan1-dance-10frames.bvh': ['Hips', 'LeftLeg', 'RightFoot', 'LeftForeArm', 'RightHand', 'Head'],
  'makehuman-tpose-add.bvh': ['root', 'lowerleg01.L', 'foot.R', 'lowerarm01.L', 'wrist.R', 'head'],
  'mixamo-names.bvh': [
    'mixamorig:Hips',
    'mixamorig:LeftLeg',
    'mixamorig:RightFoot',
    'mixamorig:LeftForeArm',
    'mixamorig:RightHand',
    'mixamorig:Head',
  ],
  'no-end-sites.bvh': ['pelvis', 'ltibia', 'rfoot', 'lradius', 'rhand', 'Neck'],
  'openni-kinect-hash-names.bvh': ['TORSO#', 'LEFT_KNEE', 'RIGHT_FOOT', 'LEFT_ELBOW', 'RIGHT_HAND', 'HEAD'],
  'perception-neuron-course.bvh': ['Hips', 'LeftLeg', 'RightFoot', 'LeftForeArm', 'RightHand', 'Head'],
  'poser-sl-walk.bvh': ['hip', 'lShin', 'rFoot', 'lForeArm', 'rHand', 'head'],
  'rokoko-dance.bvh': ['Hips', 'LeftLeg', 'RightFoot', 'LeftForeArm', 'RightHand', 'Head'],
  'xsens-armchair.bvh': ['Hips', 'LeftKnee', 'RightAnkle', 'LeftElbow', 'RightWrist', 'Head'],
};

describeShared('the files of data/bvh, on the walker', () => {
  const files = hasShared ? readdirSync(sharedPath('data/bvh')).filter((f) => f.endsWith('.bvh')) : [];

  it.each(files.filter((f) => !f.startsWith('dialect')))('%s: hips, knees, feet, elbows, hands and head', (file) => {
    const { figure: capture } = read(file);
    const pairs = automaticPairs(capture.skeleton, WALKER_SKELETON, guessSpace(capture.skeleton, capture.take));
    const follows = new Map(
      pairs.map((p) => [WALKER_SKELETON.joints[p.target].name, capture.skeleton.joints[p.source].name]),
    );
    expect(['hips', 'shin_l', 'foot_r', 'forearm_l', 'hand_r', 'head'].map((name) => follows.get(name))).toEqual(
      ESSENTIAL[file],
    );
    // The other side is the mirror image.
    const source = new Map(
      pairs.map((p) => [WALKER_SKELETON.joints[p.target].name, readName(capture.skeleton.joints[p.source].name)]),
    );
    for (const joint of ['upper_arm', 'forearm', 'hand', 'thigh', 'shin', 'foot']) {
      expect(source.get(`${joint}_l`)?.side).toBe('left');
      expect(source.get(`${joint}_r`)?.side).toBe('right');
      expect(source.get(`${joint}_l`)?.word).toBe(source.get(`${joint}_r`)?.word);
    }
  });
});

function read(file: string) {
  const { value } = readBvh(sharedBytes(`data/bvh/${file}`), file);
  const capture = value?.[0];
  if (!capture) throw new Error(`${file} has no figure`);
  return { figure: capture };
}

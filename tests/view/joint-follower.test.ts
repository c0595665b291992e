import { Vector3 } from 'three';
import { beforeEach, expect, it } from 'vitest';
import { JointFollower } from '../../src/view/joint-follower.ts';

/** Position of every joint. */
const place = new Vector3();
let moves: string[];
let follower: JointFollower;
beforeEach(() => {
  place.set(1, 0, 0);
  moves = [];
  follower = new JointFollower();
});

const skeletons = {
  positionOf: (_characterId: string, _copy: number, _joint: number, into: Vector3) => {
    into.copy(place);
    return true;
  },
};
const rig = {
  moveTo: ({ x }: Vector3) => void moves.push(`to ${x}`),
  shift: ({ x }: Vector3) => void moves.push(`by ${x}`),
};
function follow(x: number, isHeld = false, joint = 0): void {
  place.x = x;
  follower.follow({ id: 'c1' }, 0, joint, skeletons, rig, isHeld);
}

it('goes to a joint, and along with it', () => {
  follow(1);
  follow(3);
  follow(4, false, 1);
  expect(moves).toEqual(['to 1', 'by 2', 'to 4']);
});

it('stays while it is held, and goes on from where the joint is then', () => {
  follow(1);
  follow(3, true);
  follow(5, true);
  follow(6);
  expect(moves).toEqual(['to 1']);
  follow(8);
  expect(moves).toEqual(['to 1', 'by 2']);
});

it('does not go to the joint that a drag has left selected, but along with it', () => {
  follow(1);
  follow(3, true);
  follow(5, false, 1);
  follow(6, false, 1);
  expect(moves).toEqual(['to 1', 'by 1']);
});

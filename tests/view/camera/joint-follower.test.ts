import { Vector3 } from 'three';
import { beforeEach, expect, it } from 'vitest';
import { JointFollower } from '../../../src/view/camera/joint-follower.ts';

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
function follow(x: number, joint = 0): void {
  place.x = x;
  follower.follow({ id: 'c1' }, 0, joint, skeletons, rig);
}

it('goes to a joint, and along with it', () => {
  follow(1);
  follow(3);
  follow(4, 1);
  expect(moves).toEqual(['to 1', 'by 2', 'to 4']);
});

it('stays while it is held, and goes on from where the joint is then', () => {
  follow(1);
  const release = follower.hold();
  follow(3);
  follow(5);
  release();
  follow(6);
  expect(moves).toEqual(['to 1']);
  follow(8);
  expect(moves).toEqual(['to 1', 'by 2']);
});

it('does not go to the joint that a drag has left selected, but along with it', () => {
  follow(1);
  const release = follower.hold();
  follow(3);
  release();
  follow(5, 1);
  follow(6, 1);
  expect(moves).toEqual(['to 1', 'by 1']);
});

it('is held until all who hold it have let go, each of which counts once', () => {
  follow(1);
  const releases = [follower.hold(), follower.hold()];
  releases[0]();
  releases[0]();
  follow(3);
  expect(moves).toEqual(['to 1']);
  releases[1]();
  follow(4);
  follow(6);
  expect(moves).toEqual(['to 1', 'by 2']);
});

it('goes along with a root over the ground, from where the camera looks', () => {
  const shifts: Vector3[] = [];
  const along = { moveTo: rig.moveTo, shift: (by: Vector3) => void shifts.push(by.clone()) };
  for (const [x, y] of [
    [1, 1],
    [3, 1.2],
    [3, 0.9],
  ]) {
    place.set(x, y, 0);
    follower.follow({ id: 'c1' }, 0, 'root', skeletons, along);
  }
  expect(moves).toEqual([]);
  expect(shifts).toEqual([new Vector3(2, 0, 0), new Vector3(0, 0, 0)]);
});

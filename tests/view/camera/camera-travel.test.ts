import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import {
  CameraTravel,
  CLICK_PIXELS,
  FARTHEST,
  limitView,
  PressWatch,
  type View,
} from '../../../src/view/camera/camera-travel.ts';

const view = (x: number, azimuth: number, distance: number): View => ({
  target: new Vector3(x, 0, 0),
  azimuth,
  polar: 1,
  distance,
});

describe('a move of the camera', () => {
  it('starts with the first frame, and stops at its end', () => {
    const travel = new CameraTravel();
    travel.begin(view(0, 0, 1), view(10, 1, 4));
    expect(travel.goal).toEqual(view(10, 1, 4));
    expect(travel.at(5000)).toEqual(view(0, 0, 1));
    expect(travel.at(10_000)).toEqual(view(10, 1, 4));
    expect(travel.goal).toBeUndefined();
    expect(travel.at(10_001)).toBeUndefined();
  });

  it('a move of the camera turns the short way, and zooms geometrically', () => {
    const travel = new CameraTravel();
    travel.begin(view(0, 3, 1), view(10, -3, 16));
    travel.at(1);
    const half = travel.at(60);
    const done = (half?.target.x ?? 0) / 10;
    expect(done).toBeGreaterThan(0.1);
    expect(half?.azimuth).toBeCloseTo(3 + done * (2 * Math.PI - 6), 9);
    expect(half?.distance).toBeCloseTo(16 ** done, 9);
  });

  it('moves along with what it follows', () => {
    const travel = new CameraTravel();
    travel.begin(view(0, 0, 1), view(10, 0, 1));
    travel.shift(new Vector3(2, 0, 0));
    expect(travel.at(1)?.target.x).toBe(2);
    expect(travel.goal?.target.x).toBe(12);
  });
});

describe('a press', () => {
  const at = (clientX: number, buttons = 1) => ({ clientX, clientY: 50, buttons });

  it('a press is a click as far as a hand trembles, and a drag from there on', () => {
    const press = new PressWatch();
    press.press(at(100));
    expect(press.isDrag(at(100 + CLICK_PIXELS))).toBe(false);
    expect(press.isDrag(at(101 + CLICK_PIXELS))).toBe(true);
  });

  it('a press is none while no button is down', () => {
    const press = new PressWatch();
    expect(press.isDrag(at(200))).toBe(false);
    press.press(at(100));
    expect(press.isDrag(at(200, 0))).toBe(false);
  });
});

it('a view is limited to what can be drawn, and refused if it has no numbers', () => {
  const limited = (x: number, distance: number) => {
    const one = view(x, 0, distance);
    return limitView(one) && [one.target.x, one.distance];
  };
  expect(limited(3, 5)).toEqual([3, 5]);
  expect(limited(-1e308, Number.POSITIVE_INFINITY)).toEqual([-FARTHEST, FARTHEST]);
  expect(limited(0, 1e-300)).toEqual([0, 1e-15]);
  // One unit away from there is nowhere.
  expect(limited(1e15, 1)).toEqual([1e15, expect.closeTo(1e6, 3)]);
  expect(limited(Number.NaN, 1)).toBe(false);
  expect(limited(0, Number.NaN)).toBe(false);
  expect(limitView(view(0, Number.POSITIVE_INFINITY, 1))).toBe(false);
});

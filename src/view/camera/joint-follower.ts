/**
 * Makes the camera follow the selected joint: moves to it when it is selected, then along with it. A root is only
 * followed over the ground, from wherever the camera looks.
 */
import { Vector3 } from 'three';
import type { Character } from '../../model/document.ts';
import type { SkeletonDrawing } from '../skeleton/skeleton-drawing.ts';
import type { CameraRig } from './camera.ts';

export class JointFollower {
  private characterId: string | undefined;
  private copy = 0;
  private joint: number | 'root' = -1;
  /** Drags that hold the camera. */
  private holds = 0;
  private wasHeld = false;
  private readonly last = new Vector3();
  private readonly step = new Vector3();
  private readonly point = new Vector3();

  /** The camera stays until the returned function is called; following resumes from where the joint is then. */
  hold(): () => void {
    let isHeld = true;
    this.holds++;
    return () => {
      if (isHeld) this.holds--;
      isHeld = false;
    };
  }

  /**
   * Call every frame in which something moved.
   *
   * @param character undefined: nothing is followed
   * @param copy index of its placement
   * @param joint index; 'root': the first joint's way over the ground
   */
  follow(
    character: Pick<Character, 'id'> | undefined,
    copy: number,
    joint: number | 'root' | undefined,
    skeletons: Pick<SkeletonDrawing, 'positionOf'>,
    rig: Pick<CameraRig, 'shift' | 'moveTo'>,
  ): void {
    const { point } = this;
    const isHeld = this.holds > 0;
    // Changes at the end of a drag belong to the drag: the camera doesn't jump to another joint or position then.
    const stays = isHeld || this.wasHeld;
    this.wasHeld = isHeld;
    const characterId = character?.id;
    const isRoot = joint === 'root';
    const index = isRoot ? 0 : joint;
    const found =
      characterId !== undefined && index !== undefined && skeletons.positionOf(characterId, copy, index, point);
    if (!found || joint === undefined) {
      this.characterId = undefined;
      return;
    }
    const isSame = this.characterId === characterId && this.copy === copy && this.joint === joint;
    if (isRoot) point.y = 0;
    if (!stays) {
      if (isSame) rig.shift(this.step.subVectors(point, this.last));
      else if (!isRoot) rig.moveTo(point);
    }
    this.characterId = characterId;
    this.copy = copy;
    this.joint = joint;
    this.last.copy(point);
  }
}

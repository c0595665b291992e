/** Makes the camera follow the selected joint: moves to it when it is selected, then along with it. */
import { Vector3 } from 'three';
import type { Character } from '../model/document.ts';
import type { CameraRig } from './camera.ts';
import type { SkeletonDrawing } from './skeleton-drawing.ts';

export class JointFollower {
  private characterId: string | undefined;
  private copy = 0;
  private joint = -1;
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
   */
  follow(
    character: Pick<Character, 'id'> | undefined,
    copy: number,
    joint: number | undefined,
    skeletons: Pick<SkeletonDrawing, 'positionOf'>,
    rig: Pick<CameraRig, 'shift' | 'moveTo'>,
  ): void {
    const { point } = this;
    const isHeld = this.holds > 0;
    // Changes at the end of a drag belong to the drag: the camera doesn't jump to another joint or position then.
    const stays = isHeld || this.wasHeld;
    this.wasHeld = isHeld;
    const characterId = character?.id;
    const found =
      characterId !== undefined && joint !== undefined && skeletons.positionOf(characterId, copy, joint, point);
    if (!found) {
      this.characterId = undefined;
      return;
    }
    const isSame = this.characterId === characterId && this.copy === copy && this.joint === joint;
    if (!stays) {
      if (isSame) rig.shift(this.step.subVectors(point, this.last));
      else rig.moveTo(point);
    }
    this.characterId = characterId;
    this.copy = copy;
    this.joint = joint;
    this.last.copy(point);
  }
}

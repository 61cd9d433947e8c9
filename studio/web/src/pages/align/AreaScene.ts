// The mesh with the map on its patch, in a view.
import { BufferAttribute, BufferGeometry, CanvasTexture, DoubleSide, Mesh, MeshStandardMaterial, NearestFilter, SRGBColorSpace } from "three";
import type { Block } from "../../net/block";
import { themeColour } from "../../plot/colours";
import { meshFromBlock } from "../../view3d/helpers";
import type { View } from "../../view3d/View";
import { patchCorners } from "./area";

export class AreaScene {
  private readonly mesh: Mesh;
  private readonly patch: Mesh<BufferGeometry, MeshStandardMaterial>;

  constructor(
    private readonly view: View,
    block: Block,
    picture: HTMLCanvasElement,
  ) {
    const mesh = meshFromBlock(block, "positions", "indices", { colour: themeColour("--view-mesh") });
    mesh.material.polygonOffset = true;
    mesh.material.polygonOffsetFactor = 2;
    mesh.material.polygonOffsetUnits = 8;
    this.mesh = view.add(mesh);
    const { positions, uv } = patchCorners(block);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("uv", new BufferAttribute(uv, 2));
    geometry.computeVertexNormals();
    const map = new CanvasTexture(picture);
    map.colorSpace = SRGBColorSpace;
    map.magFilter = NearestFilter;
    // Holes are transparent: the mesh is seen there.
    const material = new MeshStandardMaterial({ map, alphaTest: 0.5, transparent: true, roughness: 0.9, metalness: 0, side: DoubleSide });
    this.patch = view.add(new Mesh(geometry, material));
  }

  /** Shows the patch from the position of the viewer; the whole mesh if there is none. */
  fit(): void {
    this.view.fit(this.patch.geometry.getAttribute("position").count > 0 ? this.patch : this.mesh);
  }

  /** The picture has other colours. */
  repaint(): void {
    this.patch.material.map!.needsUpdate = true;
    this.view.invalidate();
  }

  destroy(): void {
    this.patch.material.map?.dispose();
    this.view.remove(this.patch);
    this.view.remove(this.mesh);
  }
}

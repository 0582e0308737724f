/** Where the vertices of the mesh are on the surface as it is drawn, which may have several corners for one vertex, or none. */
import { Vector3 } from 'three';
import type { Surface } from 'morse-smooth/snapshot';

export class Places {
  /** Where the corners of each vertex begin: they follow one another, in the order of the vertices. */
  private readonly first: Uint32Array;

  constructor(private readonly surface: Surface) {
    const { vertices } = surface;
    this.first = new Uint32Array((vertices.at(-1) ?? -1) + 2);
    for (const vertex of vertices) this.first[vertex + 1]! += 1;
    for (let vertex = 0; vertex + 1 < this.first.length; vertex++) this.first[vertex + 1]! += this.first[vertex]!;
  }

  /** Whether the vertex is in any triangle. */
  has(vertex: number): boolean {
    return vertex + 1 < this.first.length && this.first[vertex]! < this.first[vertex + 1]!;
  }

  position(vertex: number): Vector3 {
    return new Vector3().fromArray(this.surface.positions, 3 * this.first[vertex]!);
  }

  /** What stands upright on the surface: the mean of the normals at the vertex. */
  axis(vertex: number): Vector3 {
    const sum = new Vector3();
    const normal = new Vector3();
    for (let corner = this.first[vertex]!; corner < this.first[vertex + 1]!; corner++)
      sum.add(normal.fromArray(this.surface.normals, 3 * corner));
    return sum.lengthSq() > 0 ? sum.normalize() : sum.set(0, 0, 1);
  }

  /** The positions of vertices, one after the other. */
  positions(vertices: ArrayLike<number>): Float32Array<ArrayBuffer> {
    const points = new Float32Array(3 * vertices.length);
    for (let k = 0; k < vertices.length; k++) this.position(vertices[k]!).toArray(points, 3 * k);
    return points;
  }
}

// Clouds from volumes: voxels in bricks of 9^3, neighbours overlapping by one so that each filters by itself, one after
// another in one texture of all grids. The index, one texel for each brick of a grid (the grids on top of each other),
// says where a brick lies in it; empty ones share one of zeros.

struct GridParams {
  vec4 rowX, rowY, rowZ; // voxel coordinates, whole at centres, of a point q of cloud space: dot(row.xyz, q) + row.w
  vec4 voxels;           // number of voxels less one; w: first slice of the grid in the index
  vec4 bricks;           // number of bricks
  vec4 index;            // 1 / texels of the index
  vec4 atlas;            // 1 / texels of the bricks
  ScatterParams scatter;
};

// Extinction in 1/m at a point of the cloud itself, and 1 inside the box, -1 outside, where there is none.
FN Vec2 gridExtinction(IN(Vec3) q, IN(GridParams) g, IN(Sampler3) index, IN(Sampler3) bricks) {
  Vec3 v = Vec3(g.rowX.x * q.x + g.rowX.y * q.y + g.rowX.z * q.z + g.rowX.w,
                g.rowY.x * q.x + g.rowY.y * q.y + g.rowY.z * q.z + g.rowY.w,
                g.rowZ.x * q.x + g.rowZ.y * q.y + g.rowZ.z * q.z + g.rowZ.w);
  Mask inside = both(both(both(v.x >= 0.0f, v.x <= g.voxels.x), both(v.y >= 0.0f, v.y <= g.voxels.y)),
                     both(v.z >= 0.0f, v.z <= g.voxels.z));
  Vec3 brick = Vec3(clamp(floor(v.x * 0.125f), 0.0f, g.bricks.x - 1.0f),
                    clamp(floor(v.y * 0.125f), 0.0f, g.bricks.y - 1.0f),
                    clamp(floor(v.z * 0.125f), 0.0f, g.bricks.z - 1.0f));
  Vec4 place = sample3(index, Vec3((brick.x + 0.5f) * g.index.x, (brick.y + 0.5f) * g.index.y,
                                   (brick.z + g.voxels.w + 0.5f) * g.index.z));
  Vec3 at = Vec3(9.0f * floor(place.x * 255.0f + 0.5f) + clamp(v.x - 8.0f * brick.x, 0.0f, 8.0f) + 0.5f,
                 9.0f * floor(place.y * 255.0f + 0.5f) + clamp(v.y - 8.0f * brick.y, 0.0f, 8.0f) + 0.5f,
                 9.0f * floor(place.z * 255.0f + 0.5f) + clamp(v.z - 8.0f * brick.z, 0.0f, 8.0f) + 0.5f);
  Real sigma = sample3(bricks, Vec3(at.x * g.atlas.x, at.y * g.atlas.y, at.z * g.atlas.z)).x;
  return select(inside, Vec2(sigma, 1.0f), Vec2(0.0f, -1.0f));
}

/* The only C++ here: Voro++ (0.4.6) behind the plain C of voronoi.h. One container holds all points and is read only
 * while threads compute, each with its own search state (voro_compute) and cell.
 *
 * Voro++ compares with an absolute tolerance of 1e-11 in the square of its length unit. Coordinates are therefore
 * multiplied by a power of two (which rounds nothing) that makes the spacing 1 to 16: the tolerance is then 1e-11 to
 * 4e-14 of a squared spacing, above the rounding of the coordinates and far below any face that matters. */
extern "C" {
#include "../../host/base/status.h"
#include "walls.h"
}
#include "voronoi.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <vector>
#include <voro++/voro++.hh>

namespace
{

/* Voro++ ends the program when one search block holds 2^24 points; far fewer than that is already useless. */
constexpr int MOST_IN_BLOCK = 10000;
/* Planes within so many spacings of a seed cut its cell at the start, so that it never grows far outside; what else can
 * reach the finished cell cuts it afterwards. */
constexpr double FIRST_REACH = 2.0;

template <class Cell>
bool cut_by_plane(const brc_walls &walls, Cell &cell, int32_t k, const double x[3], double scale, double low,
                  double high)
{
    const double depth = brc_walls_depth(&walls, k, x);
    if (depth < low || depth >= high) return true;
    /* Voro++'s plane is {y : y . a <= b / 2}; a is about a branch vector long, so that its tolerance means the same */
    const double *n = brc_walls_normal(&walls, k);
    return cell.nplane(10.0 * n[0], 10.0 * n[1], 10.0 * n[2], 20.0 * depth * scale, BRC_PLANE(k));
}

/* Cut a cell by the planes with low <= depth < high; depths and reach in metres. */
template <class Cell>
bool cut_by_planes(const brc_walls &walls, Cell &cell, const double x[3], double scale, double low, double high)
{
    int64_t first, count;
    brc_walls_near(&walls, x, high, &first, &count);
    for (int64_t m = first; m < first + count; ++m)
        if (!cut_by_plane(walls, cell, static_cast<int32_t>(m % walls.n_planes), x, scale, low, high)) return false;
    for (int32_t k = walls.n_planes; k < walls.n_planes + walls.n_flats; ++k)
        if (!cut_by_plane(walls, cell, k, x, scale, low, high)) return false;
    return true;
}

class planes final : public voro::wall
{
  public:
    planes(const brc_walls &walls, double scale, double reach) : walls_(walls), scale_(scale), reach_(reach)
    {
    }
    bool point_inside(double, double, double) override
    {
        return true;
    } /* checked before */
    bool cut_cell(voro::voronoicell &cell, double x, double y, double z) override
    {
        return cut(cell, x, y, z);
    }
    bool cut_cell(voro::voronoicell_neighbor &cell, double x, double y, double z) override
    {
        return cut(cell, x, y, z);
    }

  private:
    template <class Cell> bool cut(Cell &cell, double x, double y, double z)
    {
        const double position[3] = {x / scale_, y / scale_, z / scale_};
        return cut_by_planes(walls_, cell, position, scale_, -HUGE_VAL, reach_);
    }
    const brc_walls &walls_;
    const double scale_, reach_;
};

/* A power of two that makes `spacing` as large as the rounding of coordinates up to `farthest` allows, 1 to 16: on a
 * regular grid corners coincide to rounding, and Voro++ must see them as one. */
double scale_for(double spacing, double farthest)
{
    const double rounding = 30.0 * 2.2e-16 * farthest / spacing;
    const double length = std::fmin(16.0, std::fmax(2.0, std::sqrt(voro::tolerance / rounding)));
    int exponent;
    std::frexp(length / spacing, &exponent); /* = f 2^exponent with f in [1/2, 1) */
    return std::ldexp(1.0, exponent - 1);
}

int n_blocks(double width, double spacing)
{
    const double n = std::floor(width / (spacing * std::cbrt(voro::optimal_particles)));
    return n < 1.0 ? 1 : n > 4096.0 ? 4096 : static_cast<int>(n);
}

} // namespace

struct brc_voronoi {
    const double *position;
    const brc_walls *walls;
    double scale, reach;
    std::unique_ptr<planes> wall;
    std::unique_ptr<voro::container> container;
    std::vector<int> block, slot; /* where each point lies in the container */
};

struct brc_voronoi_worker {
    const brc_voronoi &voronoi;
    voro::voro_compute<voro::container> compute;
    voro::voronoicell_neighbor cell;
    std::vector<double> vertex;
    std::vector<int32_t> face_start, face_vertex, face_other;

    explicit brc_voronoi_worker(const brc_voronoi &v)
        : voronoi(v), compute(*v.container, v.container->nx, v.container->ny, v.container->nz)
    {
    }
};

/* Put a point into the container; refuse what Voro++ would lose or end the program over. Ghosts are counted on after
 * the n seeds. */
static brc_status put(brc_context *context, brc_voronoi &v, int64_t id, int64_t n, const double *x)
{
    voro::container &c = *v.container;
    const double y[3] = {x[0] * v.scale, x[1] * v.scale, x[2] * v.scale};
    /* Voro++'s own formula for the block, needed before put() to know the crowd and to find the point again */
    int index[3];
    const double low[3] = {c.ax, c.ay, c.az}, inverse[3] = {c.xsp, c.ysp, c.zsp};
    const int blocks[3] = {c.nx, c.ny, c.nz};
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
        index[k] = static_cast<int>(std::floor((y[k] - low[k]) * inverse[k]));
        inside = inside && index[k] >= 0 && index[k] < blocks[k];
    }
    const int block = index[0] + c.nx * (index[1] + c.ny * index[2]);
    if (!inside && id >= n)
        return BRC_FAIL(context, BRC_INTERNAL, "a mirror image at (%g, %g, %g) m lies outside the box of the search",
                        x[0], x[1], x[2]);
    if (!inside)
        return BRC_FAIL(context, BRC_BAD_INPUT, "seed %lld at (%g, %g, %g) m touches the outline of the shape",
                        (long long)id, x[0], x[1], x[2]);
    const int crowd = c.co[block];
    if (crowd >= MOST_IN_BLOCK)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "seeds: more than %d points crowd near (%g, %g, %g) m; spread the seeds more evenly",
                        MOST_IN_BLOCK, x[0], x[1], x[2]);
    for (int q = 0; q < crowd; ++q) { /* equal points share a block */
        const double *other = c.p[block] + 3 * q;
        if (other[0] == y[0] && other[1] == y[1] && other[2] == y[2])
            return BRC_FAIL(context, BRC_BAD_INPUT,
                            "%s %lld and %lld (counted from 0) are the same point (%g, %g, %g) m; remove one of them",
                            id < n ? "seeds" : "points (mirror images come last)", (long long)c.id[block][q],
                            (long long)id, x[0], x[1], x[2]);
    }
    c.put(static_cast<int>(id), y[0], y[1], y[2]);
    if (c.co[block] != crowd + 1 || c.id[block][crowd] != id)
        return BRC_FAIL(context, BRC_INTERNAL, "Voro++ did not take seed %lld", (long long)id);
    if (id >= n) return BRC_OK;
    v.block[static_cast<size_t>(id)] = block;
    v.slot[static_cast<size_t>(id)] = crowd;
    return BRC_OK;
}

static brc_status fill_container(brc_context *context, brc_voronoi &v, int64_t n)
{
    v.block.resize(static_cast<size_t>(n));
    v.slot.resize(static_cast<size_t>(n));
    for (int64_t e = 0; e < n; ++e) {
        const double *x = v.position + 3 * e;
        if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
            return BRC_FAIL(context, BRC_BAD_INPUT, "seed %lld: position (%g, %g, %g) is not finite", (long long)e,
                            x[0], x[1], x[2]);
        /* whoever made ghosts has asked the solid already */
        if (v.walls->n_ghosts == 0 && !brc_walls_inside(v.walls, x, 0.0))
            return BRC_FAIL(context, BRC_BAD_INPUT, "seed %lld at (%g, %g, %g) m lies outside the shape", (long long)e,
                            x[0], x[1], x[2]);
        BRC_TRY(put(context, v, e, n, x));
    }
    for (int64_t g = 0; g < v.walls->n_ghosts; ++g)
        BRC_TRY(put(context, v, n + g, n, v.walls->ghost + 3 * g));
    return BRC_OK;
}

extern "C" brc_status brc_voronoi_create(brc_context *context, const double *position, int64_t n,
                                         const brc_walls *walls, double spacing, brc_voronoi **out)
{
    *out = nullptr;
    if (n < 1 || n + walls->n_ghosts > INT32_MAX)
        return BRC_FAIL(context, BRC_BAD_INPUT,
                        "%lld seeds: there must be at least 1 and fewer than 2^31 with their mirror images",
                        (long long)n);
    try {
        std::unique_ptr<brc_voronoi> v(new brc_voronoi);
        v->position = position;
        v->walls = walls;
        double farthest = spacing;
        for (int k = 0; k < 3; ++k)
            farthest = std::fmax(farthest, std::fmax(std::fabs(walls->box[0][k]), std::fabs(walls->box[1][k])));
        v->scale = scale_for(spacing, farthest);
        v->reach = FIRST_REACH * spacing;
        int blocks[3];
        double low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            low[k] = walls->box[0][k] * v->scale;
            high[k] = walls->box[1][k] * v->scale;
            blocks[k] = n_blocks(walls->box[1][k] - walls->box[0][k], spacing);
        }
        v->container.reset(new voro::container(low[0], high[0], low[1], high[1], low[2], high[2], blocks[0], blocks[1],
                                               blocks[2], false, false, false, 8));
        if (walls->n_planes + walls->n_flats > 0) {
            v->wall.reset(new planes(*walls, v->scale, v->reach));
            v->container->add_wall(*v->wall);
        }
        const brc_status status = fill_container(context, *v, n);
        if (status != BRC_OK) return status;
        *out = v.release();
        return BRC_OK;
    } catch (const std::bad_alloc &) {
        return BRC_FAIL(context, BRC_NO_MEMORY, "out of memory while sorting %lld seeds", (long long)n);
    } catch (...) {
        return BRC_FAIL(context, BRC_INTERNAL, "Voro++ failed while sorting %lld seeds", (long long)n);
    }
}

extern "C" void brc_voronoi_free(brc_voronoi **voronoi)
{
    if (!voronoi) return;
    delete *voronoi;
    *voronoi = nullptr;
}

extern "C" brc_voronoi_worker *brc_voronoi_worker_create(const brc_voronoi *voronoi)
{
    try {
        return new brc_voronoi_worker(*voronoi);
    } catch (...) {
        return nullptr;
    }
}

extern "C" void brc_voronoi_worker_free(brc_voronoi_worker **worker)
{
    if (!worker) return;
    delete *worker;
    *worker = nullptr;
}

/* Walk the edges of Voro++'s cell into faces; walked edges are marked by -1 - k and restored at the end. */
static void read_faces(brc_voronoi_worker &w)
{
    voro::voronoicell_neighbor &c = w.cell;
    w.face_start.assign(1, 0);
    w.face_vertex.clear();
    w.face_other.clear();
    for (int i = 0; i < c.p; ++i)
        for (int j = 0; j < c.nu[i]; ++j) {
            int k = c.ed[i][j];
            if (k < 0) continue;
            w.face_other.push_back(c.ne[i][j]);
            w.face_vertex.push_back(i);
            c.ed[i][j] = -1 - k;
            int l = c.cycle_up(c.ed[i][c.nu[i] + j], k);
            while (k != i) {
                w.face_vertex.push_back(k);
                const int next = c.ed[k][l];
                c.ed[k][l] = -1 - next;
                l = c.cycle_up(c.ed[k][c.nu[k] + l], next);
                k = next;
            }
            /* Voro++ goes round clockwise seen from outside */
            std::reverse(w.face_vertex.begin() + w.face_start.back(), w.face_vertex.end());
            w.face_start.push_back(static_cast<int32_t>(w.face_vertex.size()));
        }
    for (int i = 0; i < c.p; ++i)
        for (int j = 0; j < c.nu[i]; ++j)
            c.ed[i][j] = -1 - c.ed[i][j];
}

extern "C" brc_status brc_voronoi_cell(brc_voronoi_worker *worker, int64_t e, brc_polyhedron *cell)
{
    brc_voronoi_worker &w = *worker;
    const brc_voronoi &v = w.voronoi;
    voro::container &con = *v.container;
    try {
        const int block = v.block[static_cast<size_t>(e)];
        const int k = block / (con.nx * con.ny), rest = block - k * con.nx * con.ny;
        if (!w.compute.compute_cell(w.cell, block, v.slot[static_cast<size_t>(e)], rest % con.nx, rest / con.nx, k))
            return BRC_INTERNAL;
        if (v.walls->n_planes + v.walls->n_flats > 0) {
            double square = 0.0; /* Voro++ keeps corners times two */
            for (const double *p = w.cell.pts; p < w.cell.pts + 3 * w.cell.p; p += 3)
                square = std::fmax(square, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            const double reach = 0.5 * std::sqrt(square) / v.scale * (1.0 + 1e-9);
            if (reach > v.reach && !cut_by_planes(*v.walls, w.cell, v.position + 3 * e, v.scale, v.reach, reach))
                return BRC_INTERNAL;
        }
        const double unscale = 0.5 / v.scale;
        w.vertex.resize(3 * static_cast<size_t>(w.cell.p));
        for (size_t d = 0; d < w.vertex.size(); ++d)
            w.vertex[d] = w.cell.pts[d] * unscale;
        read_faces(w);
    } catch (const std::bad_alloc &) {
        return BRC_NO_MEMORY;
    } catch (...) {
        return BRC_INTERNAL;
    }
    cell->n_vertices = w.cell.p;
    cell->n_faces = static_cast<int32_t>(w.face_other.size());
    cell->vertex = w.vertex.data();
    cell->face_start = w.face_start.data();
    cell->face_vertex = w.face_vertex.data();
    cell->face_other = w.face_other.data();
    return BRC_OK;
}

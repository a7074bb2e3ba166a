using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Simplification;

/// <summary>
/// Holds the quadric of each vertex, with its origin there: the planes of the faces around it now, and a memory of those that were.
/// </summary>
/// <remarks>
/// Sums of all planes that ever met at a vertex, as Garland and Heckbert have them, count the same plane several times. The faces of now
/// alone are closer to the surface on average (P. Lindstrom, G. Turk, "Fast and memory efficient polygonal simplification", 1998), but
/// drift where much is removed. A tenth of the memory had the smallest errors (docs/research/simplification.md).
/// </remarks>
internal sealed class VertexQuadrics
{
    private const double MemoryWeight = 0.1;

    // Of the squared distance from a border's plane, as a part of the edge's length squared.
    private const double BorderWeight = 0.5;

    // Faces of a star one of which may have changed without an update. So the hub of a large fan costs no more than other vertices.
    private const int FacesPerChange = 32;

    private readonly Vector[] _positions;
    private readonly VertexStars _stars;
    private readonly VertexStar _star;
    private readonly Quadric[] _memories;
    private readonly Quadric[] _sums;
    private readonly int[] _changes;

    /// <summary>Computes the quadrics of all vertices. Cost O(faces).</summary>
    /// <param name="positions">[vertices]; changes of it are followed by <see cref="Update"/> or <see cref="NoteChange"/>.</param>
    /// <param name="stars">Faces around the vertices.</param>
    public VertexQuadrics(Vector[] positions, VertexStars stars)
    {
        _positions = positions;
        _stars = stars;
        _star = new(stars);
        _memories = new Quadric[positions.Length];
        _sums = new Quadric[positions.Length];
        _changes = new int[positions.Length];
        for (var vertex = 0; vertex < positions.Length; vertex++)
        {
            _memories[vertex] = SumPlanes(vertex);
            _sums[vertex] = (1 + MemoryWeight) * _memories[vertex];
        }
    }

    /// <summary>The quadric of a vertex, with its origin at this vertex.</summary>
    public ref readonly Quadric this[int vertex] => ref _sums[vertex];

    /// <summary>Lets a vertex remember what another one does, before it moves.</summary>
    /// <param name="kept">The vertex that stays.</param>
    /// <param name="merged">The vertex that is merged into it.</param>
    /// <param name="offset">From the position of the first to where it is going to be.</param>
    public void Merge(int kept, int merged, Vector offset)
    {
        var memory = _memories[kept] + _memories[merged].WithOrigin(_positions[kept] - _positions[merged]);
        _memories[kept] = memory.WithOrigin(offset);
    }

    /// <summary>Computes the quadric of a vertex anew, after faces around it have changed.</summary>
    public void Update(int vertex) => _sums[vertex] = SumPlanes(vertex) + (MemoryWeight * _memories[vertex]);

    /// <summary>Notes that some faces around a vertex have changed, and updates it unless they are few of very many.</summary>
    public void NoteChange(int vertex)
    {
        _changes[vertex]++;
        if (FacesPerChange * _changes[vertex] >= _stars.CountOf(vertex))
        {
            Update(vertex);
        }
    }

    /// <summary>Sums up the planes of the faces around a vertex, weighted by area, and those that hold the border.</summary>
    /// <remarks>An edge of one face is held by the plane through it that is perpendicular to this face.</remarks>
    private Quadric SumPlanes(int vertex)
    {
        _star.Load(vertex);
        _changes[vertex] = 0;
        var sum = default(Quadric);
        foreach (var corner in _star.Corners)
        {
            var (next, previous) = _stars.OthersOf(corner);
            var (edge1, edge2) = (_positions[next] - _positions[vertex], _positions[previous] - _positions[vertex]);
            var normal = Vector.Cross(edge1, edge2);
            var length = normal.Length();
            if (length > 0)
            {
                var unitNormal = normal / length;
                sum += Quadric.Plane(unitNormal, 0.5 * length);
                if (_star[next] == 1)
                {
                    sum += BorderPlane(unitNormal, edge1);
                }

                if (_star[previous] == 1)
                {
                    sum += BorderPlane(unitNormal, edge2);
                }
            }
        }

        return sum;
    }

    private static Quadric BorderPlane(Vector normal, Vector edge) =>
        Quadric.Plane(Vector.Cross(normal, edge) / edge.Length(), BorderWeight * edge.LengthSquared());
}

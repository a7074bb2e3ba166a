using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>A low sub-fractal whose instances are one mesh, so that one triangle hierarchy searches them all.</summary>
internal sealed class ExpandedSubFractal
{
    private readonly int _baseFaceCount;

    // The child indices that lead to each instance, one instance after another, and where those of each begin.
    private readonly List<int> _childIndices = [];
    private readonly List<int> _firstChildIndices = [0];

    /// <summary>Expands a sub-fractal with finitely many instances.</summary>
    /// <param name="hierarchy">The sub-fractals.</param>
    /// <param name="baseMesh">The base mesh.</param>
    /// <param name="remainingLevels">Remaining levels of the sub-fractal.</param>
    public ExpandedSubFractal(FractalHierarchy hierarchy, Mesh baseMesh, long remainingLevels)
    {
        var instances = new List<AffineMap>();
        var path = new List<int>();
        AddAll(hierarchy.At(remainingLevels), remainingLevels, AffineMap.Identity);
        _baseFaceCount = baseMesh.FaceCount;
        Bvh = new(baseMesh.Flatten([.. instances]));

        void AddAll(SubFractal subFractal, long levels, AffineMap map)
        {
            if (levels == 0)
            {
                instances.Add(map);
                _childIndices.AddRange(path);
                _firstChildIndices.Add(_childIndices.Count);
                return;
            }

            for (var i = 0; i < subFractal.Children.Length; i++)
            {
                var child = subFractal.Children[i];
                var childLevels = child.RemainingLevels(levels);
                path.Add(i);
                AddAll(hierarchy.At(child, childLevels), childLevels, map * child.Map);
                path.RemoveAt(path.Count - 1);
            }
        }
    }

    /// <summary>The hierarchy of all triangles, in the frame of the sub-fractal.</summary>
    public TriangleBvh Bvh { get; }

    /// <summary>Number of bytes of the hierarchy, its mesh and the paths.</summary>
    public long StorageBytes => Bvh.StorageBytes + (sizeof(double) * (long)Bvh.Mesh.Positions.Length)
        + (sizeof(int) * (long)(Bvh.Mesh.VertexIndices.Length + _childIndices.Count + _firstChildIndices.Count));

    /// <summary>Finds the face of the base mesh that a face of this mesh is an instance of, and records the path to the instance.</summary>
    /// <param name="face">Face index in this mesh.</param>
    /// <param name="depth">Number of child instances that lead to the sub-fractal; receives that to the instance.</param>
    /// <param name="search">Receives the path.</param>
    public int ResolveFace(int face, ref int depth, ref FractalSearchState search)
    {
        var instance = face / _baseFaceCount;
        for (var i = _firstChildIndices[instance]; i < _firstChildIndices[instance + 1]; i++)
        {
            search.RecordChild(depth, _childIndices[i]);
            depth++;
        }

        return face % _baseFaceCount;
    }
}

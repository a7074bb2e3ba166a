using System.Runtime.InteropServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>A low sub-fractal whose instances are one mesh, so that one triangle hierarchy searches them all.</summary>
internal sealed class ExpandedSubFractal
{
    private readonly int _baseFaceCount;

    // The child indices that lead to each instance, one instance after another, and where those of each begin.
    private readonly int[] _childIndices;
    private readonly int[] _firstChildIndices;

    /// <summary>Expands a sub-fractal with finitely many instances.</summary>
    /// <param name="hierarchy">The sub-fractals.</param>
    /// <param name="baseMesh">The base mesh.</param>
    /// <param name="remainingLevels">Remaining levels of the sub-fractal.</param>
    public ExpandedSubFractal(FractalHierarchy hierarchy, Mesh baseMesh, long remainingLevels)
    {
        var instances = new ExpandedInstances(hierarchy, baseMesh);
        instances.AddAll(hierarchy.At(remainingLevels), remainingLevels, AffineMap.Identity);
        _baseFaceCount = baseMesh.FaceCount;
        _childIndices = [.. instances.ChildIndices];
        _firstChildIndices = [.. instances.FirstChildIndices];
        Bvh = new(new Mesh(
            ImmutableCollectionsMarshal.AsImmutableArray(instances.Positions.ToArray()),
            ImmutableCollectionsMarshal.AsImmutableArray(instances.VertexIndices.ToArray())));
    }

    /// <summary>The hierarchy of all triangles, in the frame of the sub-fractal.</summary>
    public TriangleBvh Bvh { get; }

    /// <summary>Number of bytes of the hierarchy, its mesh and the paths.</summary>
    public long StorageBytes => Bvh.StorageBytes + (sizeof(double) * (long)Bvh.Mesh.Positions.Length)
        + (sizeof(int) * (long)(Bvh.Mesh.VertexIndices.Length + _childIndices.Length + _firstChildIndices.Length));

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

    /// <summary>Lists the instances of a sub-fractal, with their vertices and faces.</summary>
    private sealed class ExpandedInstances(FractalHierarchy hierarchy, Mesh baseMesh)
    {
        private readonly List<int> _path = [];

        public List<int> ChildIndices { get; } = [];

        public List<int> FirstChildIndices { get; } = [0];

        public List<double> Positions { get; } = [];

        public List<int> VertexIndices { get; } = [];

        public void AddAll(SubFractal subFractal, long remainingLevels, in AffineMap map)
        {
            if (remainingLevels == 0)
            {
                AddInstance(in map);
                return;
            }

            for (var i = 0; i < subFractal.Children.Length; i++)
            {
                var child = subFractal.Children[i];
                var childLevels = child.RemainingLevels(remainingLevels);
                _path.Add(i);
                AddAll(hierarchy.At(child, childLevels), childLevels, map * child.Map);
                _path.RemoveAt(_path.Count - 1);
            }
        }

        private void AddInstance(in AffineMap map)
        {
            var firstVertex = Positions.Count / 3;
            for (var i = 0; i < baseMesh.Positions.Length; i += 3)
            {
                var (x, y, z) = map * new Vector(baseMesh.Positions[i], baseMesh.Positions[i + 1], baseMesh.Positions[i + 2]);
                Positions.Add(x);
                Positions.Add(y);
                Positions.Add(z);
            }

            foreach (var vertex in baseMesh.VertexIndices)
            {
                VertexIndices.Add(firstVertex + vertex);
            }

            ChildIndices.AddRange(_path);
            FirstChildIndices.Add(ChildIndices.Count);
        }
    }
}

using FractalEngine.Core.Bvh;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>The base meshes of a fractal, for searches that are compiled for one of them as for several.</summary>
internal interface IBaseMeshes
{
    /// <summary>Number of base meshes: levels below are base meshes, all others have children.</summary>
    int Count { get; }

    /// <summary>Number of faces of the largest.</summary>
    int MaxFaceCount { get; }

    /// <summary>The triangle hierarchy of a base mesh.</summary>
    /// <param name="index">Its index, see <see cref="FractalEngine.Core.Fractals.Levels.SubFractal.BaseIndex"/>.</param>
    TriangleBvh At(int index);
}

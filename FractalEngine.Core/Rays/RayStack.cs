using FractalEngine.Core.Fractals.Hierarchy;

namespace FractalEngine.Core.Rays;

/// <summary>The sub-fractals that a ray is inside of, from the whole fractal down. The next ray reuses the memory.</summary>
internal sealed class RayStack
{
    private RayFrame[] _frames = new RayFrame[16];
    private float[] _keys = new float[512];

    /// <summary>The frame at a depth.</summary>
    public ref RayFrame this[int depth] => ref _frames[depth];

    /// <summary>The keys of a frame's children.</summary>
    public Span<float> Keys(in RayFrame frame) => _keys.AsSpan(frame.FirstKey, frame.Bounds.KeyCount);

    /// <summary>Makes room for a frame and for its keys.</summary>
    /// <returns>Where its keys begin.</returns>
    public int Reserve(int depth, int keyCount)
    {
        if (depth == _frames.Length)
        {
            Array.Resize(ref _frames, 2 * depth);
        }

        var firstKey = depth == 0 ? 0 : _frames[depth - 1].FirstKey + _frames[depth - 1].Bounds.KeyCount;
        if (_keys.Length < firstKey + keyCount)
        {
            Array.Resize(ref _keys, 2 * (firstKey + keyCount));
        }

        return firstKey;
    }

    /// <summary>Copies the indices of the children that lead to the innermost frame and one further.</summary>
    public void CopyPath(int depth, Span<int> path)
    {
        for (var i = 0; i < depth; i++)
        {
            path[i] = _frames[i].Child;
        }
    }
}

/// <summary>A sub-fractal whose children a ray is tested against.</summary>
internal struct RayFrame
{
    /// <summary>The sub-fractal.</summary>
    public SubFractal SubFractal;

    /// <summary>Its bounds.</summary>
    public RayBounds Bounds;

    /// <summary>The ray in its frame.</summary>
    public LocalRay Ray;

    /// <summary>Its remaining levels.</summary>
    public long RemainingLevels;

    /// <summary>Upper bound of the factor from lengths in its frame to those of the query.</summary>
    public double Scale;

    /// <summary>Factor from distances along the ray of the query to the parameter of keys.</summary>
    public double PerDistance;

    /// <summary>Where the keys of its children begin.</summary>
    public int FirstKey;

    /// <summary>Index of the child that was entered last.</summary>
    public int Child;
}

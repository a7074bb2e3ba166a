using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Rays;

/// <summary>The sub-fractals that a ray is inside of, from the whole fractal down. The next ray reuses the memory.</summary>
internal sealed class RayStack
{
    private RayFrame[] _frames = new RayFrame[16];
    private float[] _keys = new float[512];

    /// <summary>The frame at a depth.</summary>
    public ref RayFrame this[int depth]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_frames), (nint)(uint)depth);
    }

    /// <summary>The first key of a frame's children.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref float Keys(in RayFrame frame) => ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_keys), (nint)(uint)frame.FirstKey);

    /// <summary>Makes room for a frame and for its keys. Frames and keys that were read before may be elsewhere then.</summary>
    /// <param name="depth">Depth of the frame.</param>
    /// <param name="lastKey">Number of keys of all frames up to it.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void EnsureRoom(int depth, int lastKey)
    {
        if (depth >= _frames.Length || lastKey > _keys.Length)
        {
            Grow(depth, lastKey);
        }
    }

    /// <summary>Copies the indices of the children that lead to a child of a frame.</summary>
    /// <param name="path">As long as there are frames.</param>
    public void CopyPath(Span<int> path)
    {
        for (var i = 0; i < path.Length; i++)
        {
            path[i] = _frames[i].Child;
        }
    }

    private void Grow(int depth, int lastKey)
    {
        Array.Resize(ref _frames, Math.Max(_frames.Length, 2 * depth));
        Array.Resize(ref _keys, Math.Max(_keys.Length, 2 * lastKey));
    }
}

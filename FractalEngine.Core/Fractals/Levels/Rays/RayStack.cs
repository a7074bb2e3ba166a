using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>The sub-fractals that a ray is inside of, from the whole fractal down. The next ray reuses the memory.</summary>
internal sealed class RayStack
{
    private RayFrame[] _frames = new RayFrame[16];
    private float[] _entries = new float[16 * RayBounds.MaxChildren];

    /// <summary>The frame at a depth.</summary>
    public ref RayFrame this[int depth]
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_frames), (nint)(uint)depth);
    }

    /// <summary>The first of the parameters where the ray enters the children of a frame.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ref float Entries(int depth) =>
        ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_entries), (nint)(uint)(depth * RayBounds.MaxChildren));

    /// <summary>Makes room for a frame. Frames that were read before may be elsewhere then.</summary>
    /// <param name="depth">Depth of the frame.</param>
    /// <returns>True where the frames have moved.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public bool EnsureRoom(int depth)
    {
        if (depth < _frames.Length)
        {
            return false;
        }

        Grow(depth);
        return true;
    }

    /// <summary>Copies the indices of the child instances that lead to the child that was entered last.</summary>
    /// <param name="depth">Depth of the frame with the child.</param>
    /// <param name="path">As long as the path.</param>
    public void CopyPath(int depth, Span<int> path)
    {
        for (var i = 0; i <= depth; i++)
        {
            ref var frame = ref _frames[i];
            frame.Bounds.Child(frame.Octant, frame.Lane).CopyPath(path[frame.PathLength..]);
        }
    }

    private void Grow(int depth)
    {
        Array.Resize(ref _frames, 2 * depth);
        Array.Resize(ref _entries, 2 * depth * RayBounds.MaxChildren);
    }
}

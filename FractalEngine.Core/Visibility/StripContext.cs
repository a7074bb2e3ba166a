using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>The context of one run of culling: the parameters of the strip and of one object, and the output.</summary>
/// <remarks>It lives on the stack while an object is culled, so that the culler itself keeps no state between runs.</remarks>
internal readonly ref struct StripContext
{
    private readonly ref readonly StripFrame _frame;

    /// <summary>Collects the parameters of a run.</summary>
    /// <param name="frame">Parameters of the strip.</param>
    /// <param name="item">Object that is culled.</param>
    /// <param name="output">Receives the visible instances.</param>
    public StripContext(ref readonly StripFrame frame, CulledObject item, StripOutput output)
    {
        _frame = ref frame;
        Hierarchy = item.Hierarchy;
        Occluder = item.Hierarchy.Occluder;
        VertexOrigin = SimdAffineMap.ToVector256(item.VertexOrigin);
        WindingSign = item.WindingSign;
        CanOcclude = item.IsOpaque && Occluder.VertexIndices.Length > 0;
        Gradient = item.GradientKind;
        HasSkyParts = frame.HasSkyVisibility && item.HasSkyMasks;
        Output = output;
    }

    /// <summary>Parameters of the strip.</summary>
    public ref readonly StripFrame Frame => ref _frame;

    /// <summary>Level-of-detail hierarchy of the object.</summary>
    public LodHierarchy Hierarchy { get; }

    /// <summary>Base mesh of the object, for the occlusion buffer.</summary>
    public OccluderMesh Occluder { get; }

    /// <summary>Point of the base mesh's frame that the drawn vertices are relative to: x, y, z, 0.</summary>
    public Vector256<double> VertexOrigin { get; }

    /// <summary>Winding of the base mesh, see <see cref="CulledObject.WindingSign"/>.</summary>
    public int WindingSign { get; }

    /// <summary>Whether instances of the object are rasterized into the occlusion buffer.</summary>
    public bool CanOcclude { get; }

    /// <summary>Kind of the object's gradient.</summary>
    public GradientKind Gradient { get; }

    /// <summary>Whether instances come with the parts of the sky that they see.</summary>
    public bool HasSkyParts { get; }

    /// <summary>Receiver of the visible instances and the statistics.</summary>
    public StripOutput Output { get; }
}

using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;

namespace FractalEngine.Render.Upload;

/// <summary>
/// The uniform blocks of a scene's objects, made at their first use. Objects whose instances are in world axes about the camera share
/// those of their colours, which stay as they are while the camera moves. All others have one of their own.
/// </summary>
internal sealed class ObjectBlocks(GlResources resources, int objectCount) : IDisposable
{
    private readonly ObjectBlock?[] _ownBlocks = new ObjectBlock?[objectCount];
    private readonly Dictionary<(Colour Colour, Colour GradientEnd), ObjectBlock> _sharedBlocks = [];

    /// <summary>Binds the block of an object whose instances are relative to the camera, in world axes.</summary>
    public void BindRelative(DrawableObject item)
    {
        var key = (item.Colour, GradientEndOf(item));
        ref var block = ref CollectionsMarshal.GetValueRefOrAddDefault(_sharedBlocks, key, out _);
        block ??= new(resources, "instances about the camera");
        block.Bind(GlState.ObjectBinding, AffineMap.Identity, key.Colour, key.Item2, Vector.Zero);
    }

    /// <summary>Binds the block of an object that is drawn whole.</summary>
    /// <param name="index">Index of the object in the scene, from 0.</param>
    /// <param name="item">The object.</param>
    /// <param name="objectToWorld">Map from the model's frame to world space.</param>
    /// <param name="cameraPosition">Position of the camera in world space.</param>
    public void Bind(int index, DrawableObject item, AffineMap objectToWorld, Vector cameraPosition)
    {
        var block = _ownBlocks[index] ??= new(resources, $"matrix of {item.Name}");
        var modelToWorld = new AffineMap(objectToWorld.Linear, objectToWorld * item.Model.Origin);
        block.Bind(GlState.ObjectBinding, modelToWorld, item.Colour, GradientEndOf(item), cameraPosition);
    }

    /// <summary>Forgets the colours of a scene that is no longer drawn.</summary>
    public void ForgetColours()
    {
        GlObject.DisposeAll([.. _sharedBlocks.Values]);
        _sharedBlocks.Clear();
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        ForgetColours();
        GlObject.DisposeAll(_ownBlocks);
    }

    private static Colour GradientEndOf(DrawableObject item) => item.Gradient?.EndColour ?? item.Colour;
}

using FractalEngine.Core.Geometry;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>Draws the depths of a scene's objects as a light sees them. Transparent surfaces cast no shadow.</summary>
internal sealed class CasterRenderer(
    GlResources resources, DrawableScene scene, SceneBuffers buffers, ObjectTransforms transforms) : IDisposable
{
    private readonly ObjectBlocks _objectBlocks = new(resources, scene.Objects.Length);

    // By whether instances are relative to the eye, then by whether a texture cuts holes.
    private readonly CasterProgram?[] _programs = new CasterProgram?[4];
    private SphereBatch? _sphereBatch;
    private ShadowView _view;
    private int _programsWithView;

    /// <summary>Scene whose objects are drawn.</summary>
    public DrawableScene Scene { get; set; } = scene;

    /// <summary>Sets the state in which maps are drawn.</summary>
    /// <param name="isCut">Whether a section plane cuts the scene.</param>
    public static void BeginMaps(bool isCut)
    {
        if (isCut)
        {
            GL.Enable(EnableCap.ClipDistance0);
        }

        GL.Enable(EnableCap.DepthTest);
        GL.DepthMask(true);
        GL.DepthFunc(DepthFunction.Greater);
        // Axes of lights are left-handed, whichever way the scene is shown.
        GL.FrontFace(FrontFaceDirection.Cw);
    }

    /// <summary>Switches off what only shadow maps are drawn with: clamped depths and the clip plane of a section.</summary>
    public static void EndMaps()
    {
        GL.Disable(EnableCap.DepthClamp);
        GL.Disable(EnableCap.ClipDistance0);
    }

    /// <summary>Begins drawing into the map of a view.</summary>
    public void Begin(in ShadowView view)
    {
        _view = view;
        _programsWithView = 0;
    }

    /// <summary>Draws the objects that stand, as far as the view shows them.</summary>
    /// <param name="culling">Settings of culling; null to draw all instances.</param>
    /// <param name="zoom">Deep zoom of the frame, with roots about the view's eye; null where the camera is in world space.</param>
    /// <param name="selection">The objects to draw.</param>
    public void DrawStatic(CullingSettings? culling, DeepZoom? zoom, CasterSelection selection)
    {
        var culler = buffers.ShadowCuller;
        if (culling is not null)
        {
            culler.Cull(_view.ToCullingView(), culling, zoom);
        }

        for (var i = 0; i < Scene.Objects.Length; i++)
        {
            var item = Scene.Objects[i];
            if (!selection.IsSelected(i))
            {
                continue;
            }

            if (culler.SelectsInstances(i))
            {
                Draw(i, isRelative: true, FaceToCull(i, culler.WindingSign(i)));
            }
            else if (!item.IsDynamic && zoom is null)
            {
                DrawWhole(i);
            }
        }
    }

    /// <summary>Draws one object with all of its instances, where it is now.</summary>
    public void DrawWhole(int index)
    {
        // Depths have no colour; that of the object stays the same, so that it causes no upload.
        _objectBlocks.Bind(index, Scene.Objects[index], transforms.ObjectToWorld[index], _view.Position);
        // A light with a position may stand within a solid.
        Draw(index, isRelative: false, CullFace.None);
    }

    /// <summary>Draws the spheres beside the objects.</summary>
    public void DrawSpheres(IReadOnlyList<SphereInstance> spheres)
    {
        _sphereBatch ??= new(resources);
        resources.State.Cull(CullFace.None);
        UseProgram(isRelative: true, isCutOut: false);
        _sphereBatch.Draw(spheres, _view.Position, Colour.White);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll([_objectBlocks, .. _programs, _sphereBatch]);

    private void Draw(int index, bool isRelative, CullFace culledFace)
    {
        var model = Scene.Objects[index].Model;
        foreach (ref readonly var batch in model.Batches.AsSpan())
        {
            if (batch.IsTransparent)
            {
                continue;
            }

            var isCutOut = batch.Material is { IsCutOut: true };
            resources.State.Cull(culledFace);
            var program = UseProgram(isRelative, isCutOut);
            if (isCutOut)
            {
                buffers.BindTexture(batch.Material);
                program.SetTexture(batch.Material!.Material.Texture!);
            }

            if (isRelative)
            {
                buffers.ShadowCuller.Draw(index, batch);
            }
            else
            {
                buffers.BuffersOf(model).Draw(batch);
            }
        }
    }

    private CasterProgram UseProgram(bool isRelative, bool isCutOut)
    {
        var index = (isRelative ? 2 : 0) + (isCutOut ? 1 : 0);
        var program = _programs[index] ??= new(resources, isRelative, isCutOut);
        program.Use();
        if ((_programsWithView & (1 << index)) == 0)
        {
            program.SetView(in _view);
            _programsWithView |= 1 << index;
        }

        return program;
    }

    /// <summary>Returns the faces of a closed solid that point away from the light; none where that is not known.</summary>
    private CullFace FaceToCull(int index, int windingSign) =>
        GlState.BackFacesOf(windingSign * Math.Sign(transforms.ObjectToWorld[index].Linear.Determinant()));
}

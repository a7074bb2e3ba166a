using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Balls that are no objects of the scene, in one draw call. Their places are uploaded anew for each picture.</summary>
internal sealed class BallInstances : IDisposable
{
    private const int Faces = 1280;

    private readonly ModelBuffers _model;
    private readonly GlBuffer _instances;
    private readonly VertexArray _array;
    private readonly ObjectBlock _block;
    private readonly List<float> _rows = [];

    /// <summary>Uploads a sphere.</summary>
    public BallInstances(GlResources resources)
    {
        var scene = new LoadedScene(new Scene(), [new(new SceneObject("ball", Transformation.Identity), new MeshModel("ball", 0, MeshGenerators.Create("icosphere", 0, Faces)))]);
        _model = new(resources, DrawableScene.Prepare(scene, new() { Detail = null }).Models[0]);
        _instances = new(resources, "balls", BufferTarget.ArrayBuffer);
        _array = new(resources, "balls");
        _model.Attach(_array, _instances);
        _block = new(resources, "balls");
    }

    /// <summary>The program for them must be in use when this is drawn.</summary>
    /// <param name="balls">All.</param>
    /// <param name="camera">World space.</param>
    /// <param name="colour">sRGB.</param>
    public void Draw(IReadOnlyList<LooseBall> balls, Vector camera, Colour colour)
    {
        _rows.Clear();
        foreach (var (centre, radius) in balls)
        {
            var (r, (x, y, z)) = ((float)radius, centre - camera);
            _rows.AddRange([r, 0, 0, (float)x, 0, r, 0, (float)y, 0, 0, r, (float)z]);
        }

        _instances.Discard(_rows.Count * sizeof(float));
        _instances.Write(CollectionsMarshal.AsSpan(_rows), 0);
        _block.Bind(MeshPass.ObjectBinding, AffineMap.Translate(camera), colour, colour, camera);
        _array.Bind();
        GL.DrawElementsInstanced(PrimitiveType.Triangles, _model.Everything.IndexCount, DrawElementsType.UnsignedInt, IntPtr.Zero, balls.Count);
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _array.Dispose();
        _instances.Dispose();
        _block.Dispose();
        _model.Dispose();
    }
}

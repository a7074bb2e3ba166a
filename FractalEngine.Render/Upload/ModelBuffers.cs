using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>A model on the GPU: one vertex array with its vertices, indices and instances (paper §4.3.1). Uploaded once.</summary>
internal sealed class ModelBuffers : IDisposable
{
    /// <summary>Location of the first row of an instance's map; the other two follow.</summary>
    public const int InstanceRowsLocation = 2;

    /// <summary>Location of what maps mix into the colour of an instance.</summary>
    public const int MapTintLocation = 10;

    private const int PositionLocation = 0;
    private const int NormalLocation = 1;
    private const int TextureCoordinatesLocation = 6;
    private const int ColourLocation = 7;

    private readonly GlBuffer _vertices;
    private readonly GlBuffer _indices;
    private readonly GlBuffer _instances;
    private readonly GlBuffer? _textureCoordinates;
    private readonly GlBuffer? _colours;
    private readonly GlBuffer? _mapTints;
    private readonly VertexArray _vertexArray;
    private readonly GlResources _resources;
    private readonly string _name;
    private readonly int _indexCount;
    private readonly int _instanceCount;
    private VertexArray? _meshAlone;

    /// <summary>Uploads the buffers of a model.</summary>
    /// <exception cref="GlException">The GPU's memory does not suffice.</exception>
    public ModelBuffers(GlResources resources, DrawableModel model)
    {
        _resources = resources;
        _name = model.Name;
        _indexCount = model.Indices.Length;
        _instanceCount = model.InstanceCount;
        _vertexArray = new(resources, model.Name);
        _vertices = new(resources, $"vertices of {model.Name}", BufferTarget.ArrayBuffer);
        _indices = new(resources, $"indices of {model.Name}", BufferTarget.ElementArrayBuffer);
        _instances = new(resources, $"instances of {model.Name}", BufferTarget.ArrayBuffer);
        _textureCoordinates = CreateUnlessEmpty(model.TextureCoordinates, "texture coordinates");
        _colours = CreateUnlessEmpty(model.Colours, "colours");
        _mapTints = CreateUnlessEmpty(model.InstanceTints, "colours of maps");
        GlObject.DisposeOnFailure(this, () => Upload(model));
    }

    /// <summary>A batch of all triangles, without a material.</summary>
    public DrawableBatch WholeMesh => new(0, _indexCount, null);

    /// <summary>Draws one batch of all instances in one call.</summary>
    public void Draw(DrawableBatch batch) => _vertexArray.DrawTriangles(batch.FirstIndex, batch.IndexCount, _instanceCount);

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(
        _meshAlone, _vertexArray, _vertices, _indices, _instances, _textureCoordinates, _colours, _mapTints);

    /// <summary>The mesh without instances: the map of one is set before each draw. Shared by all objects of the model.</summary>
    public VertexArray MeshAlone => _meshAlone ??= AttachMesh(new(_resources, $"mesh of {_name}"));

    /// <summary>Attaches the mesh to another vertex array, with instances of its own.</summary>
    /// <param name="vertexArray">Vertex array that receives the attributes.</param>
    /// <param name="instances">Rows of 3×4 maps, [instances × 12].</param>
    public void Attach(VertexArray vertexArray, GlBuffer instances)
    {
        AttachMesh(vertexArray);
        for (var row = 0; row < 3; row++)
        {
            vertexArray.Attribute(instances, InstanceRowsLocation + row, 4, DrawableModel.FloatsPerInstance, 4 * row, divisor: 1);
        }

        vertexArray.Unbind();
    }

    private GlBuffer? CreateUnlessEmpty(ReadOnlyMemory<float> values, string contents) =>
        values.IsEmpty ? null : new(_resources, $"{contents} of {_name}", BufferTarget.ArrayBuffer);

    private VertexArray AttachMesh(VertexArray vertexArray)
    {
        vertexArray.Bind();
        _indices.Bind();
        vertexArray.Attribute(_vertices, PositionLocation, 3, DrawableModel.FloatsPerVertex, 0);
        vertexArray.Attribute(_vertices, NormalLocation, 3, DrawableModel.FloatsPerVertex, 3);
        if (_textureCoordinates is not null)
        {
            vertexArray.Attribute(_textureCoordinates, TextureCoordinatesLocation, 2, 2, 0);
        }

        if (_colours is not null)
        {
            vertexArray.Attribute(_colours, ColourLocation, 3, 3, 0);
        }

        vertexArray.Unbind();
        return vertexArray;
    }

    private void Upload(DrawableModel model)
    {
        _vertexArray.Bind();
        _vertices.Upload(model.Vertices.Span, BufferUsageHint.StaticDraw);
        _indices.Upload(model.Indices.Span, BufferUsageHint.StaticDraw);
        _instances.Upload(model.Instances.Span, BufferUsageHint.StaticDraw);
        _textureCoordinates?.Upload(model.TextureCoordinates.Span, BufferUsageHint.StaticDraw);
        _colours?.Upload(model.Colours.Span, BufferUsageHint.StaticDraw);
        _mapTints?.Upload(model.InstanceTints.Span, BufferUsageHint.StaticDraw);
        if (_mapTints is not null)
        {
            _vertexArray.Attribute(_mapTints, MapTintLocation, 4, 4, 0, divisor: 1);
        }

        Attach(_vertexArray, _instances);
    }
}

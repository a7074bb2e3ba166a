using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>What a separation of overlapping bodies needs of a body.</summary>
internal struct DisplacedBody
{
    /// <summary>Displacement from the beginning of the step.</summary>
    public Vector Displacement;

    /// <summary>Displacement when contacts were last chosen that are near touching.</summary>
    public Vector ChosenDisplacement;

    /// <summary>Inverse of the mass, 1/kg; 0 for a body that is held.</summary>
    public double InverseMass;

    /// <summary>True where its way has been changed.</summary>
    public bool HasMoved;
}

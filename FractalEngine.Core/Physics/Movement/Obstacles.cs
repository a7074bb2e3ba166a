using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// Everything that one mover can collide with: static surfaces, nearby bodies and the character. Set up anew for each mover and step. A
/// mover is one sphere, or several at fixed offsets from its position.
/// </summary>
internal sealed partial class Obstacles(
    List<Body> bodies, NearbyBodies nearbyBodies, QueryContext queryContext, KinematicSet kinematics)
{
    // Relative to the radius: so far from where a query was made, its result is as good as another one.
    private const double NegligibleDistance = 0.01;

    private readonly List<int> _candidates = [];
    private StaticColliders? _staticColliders;
    private SafeDistance _safeDistance = new();
    private Vector[] _sphereOffsets = [Vector.Zero];
    private double _radius;
    private double _searchMargin;
    private CharacterController? _character;
    private BoundingBox _clearBox;
    private bool _isClear;

    /// <summary>Radius of the mover's spheres, scene units.</summary>
    public double Radius => _radius;

    /// <summary>Makes room for so many bodies near a mover.</summary>
    public void Reserve(int bodyCount) => _candidates.EnsureCapacity(bodyCount);

    /// <summary>Sets up another mover.</summary>
    /// <param name="staticColliders">Colliders of the static objects; null where there are none.</param>
    /// <param name="sphereOffsets">Offsets of the mover's spheres from its position.</param>
    /// <param name="radius">Radius of the spheres, scene units.</param>
    /// <param name="safeDistance">What is known of the distance to surfaces; receives what queries find.</param>
    /// <param name="searchMargin">How much farther queries search than asked, so that the next steps need none.</param>
    /// <param name="character">A character that is in the way; null for none.</param>
    public void SetMover(
        StaticColliders? staticColliders, Vector[] sphereOffsets, double radius, SafeDistance safeDistance, double searchMargin,
        CharacterController? character = null)
    {
        _staticColliders = staticColliders;
        _sphereOffsets = sphereOffsets;
        _radius = radius;
        _safeDistance = safeDistance;
        _searchMargin = searchMargin;
        _character = character;
        _candidates.Clear();
        _isClear = false;
    }

    /// <summary>Finds out whether the mover, one ball, may meet other bodies on its way, so that searches along it are fast.</summary>
    /// <param name="motion">Its path, unless it meets anything.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="excludedIndex">Index of the mover itself.</param>
    public void PrepareNearbyBodies(in SphereMotion motion, double duration, int excludedIndex)
    {
        _clearBox = motion.SweptBox(duration);
        _isClear = nearbyBodies.Prepare(in _clearBox, _radius * ContactTolerances.NeighbourRadiusFactor, excludedIndex);
    }

    /// <summary>Makes one ball of a compound the mover, whose nearby bodies stay collected.</summary>
    /// <param name="radius">Its radius, scene units.</param>
    /// <param name="safeDistance">What is known of the distance from its centre to surfaces.</param>
    public void SelectBall(double radius, SafeDistance safeDistance)
    {
        _radius = radius;
        _safeDistance = safeDistance;
    }

    /// <summary>Collects the other bodies near a path. Only these are tested until the next call.</summary>
    /// <param name="motion">Path of the mover.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="excludedIndex">Index of the mover itself, or <see cref="Contact.NoBody"/>.</param>
    public void CollectNearbyBodies(in SphereMotion motion, double duration, int excludedIndex)
    {
        _candidates.Clear();
        var box = duration > 0 ? motion.SweptBox(duration) : new(motion.Start, motion.Start);
        if (_isClear && _clearBox.Contains(in box))
        {
            return;
        }

        foreach (var sphere in _sphereOffsets)
        {
            box = BoundingBox.Union(box, new(box.Minimum + sphere, box.Maximum + sphere));
        }

        nearbyBodies.CollectOverlaps(in box, _radius * ContactTolerances.NeighbourRadiusFactor, excludedIndex, _candidates);
    }

    /// <summary>Drops the collected bodies that something with a layer and a mask does not meet.</summary>
    public void DropBodiesOfOtherLayers(int layer, uint mask)
    {
        for (var i = _candidates.Count - 1; i >= 0; i--)
        {
            var body = bodies[_candidates[i]].Description;
            if (!Layers.CanMeet(layer, mask, body.Layer, body.Mask))
            {
                _candidates.RemoveAt(i);
            }
        }
    }

    /// <summary>Largest gap of the mover that rounding cannot tell from 0, see <see cref="ContactTolerances.Touch"/>.</summary>
    public double TouchTolerance(Vector position) => ContactTolerances.Touch(_radius, position);

    /// <summary>Largest gap at which the mover keeps a contact, see <see cref="ContactTolerances.Slop"/>.</summary>
    public double ContactSlop(Vector position) => ContactTolerances.Slop(_radius, position);

    /// <summary>Lower bound on the free distance at a position, at most a maximum.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest; nothing beyond is searched for.</param>
    /// <param name="sufficientDistance">A bound that is known already will do if it is at least this.</param>
    public double FreeDistance(Vector position, double maxDistance, double sufficientDistance)
    {
        var known = _safeDistance.LowerBoundAt(position) - _radius;
        if (known >= sufficientDistance || _safeDistance.IsKnownNear(position, NegligibleDistance * _radius))
        {
            var distance = Math.Min(maxDistance, FreeDistanceToBodies(position, Math.Min(known, maxDistance)));
            return TryFindCloserKinematic(position, ref distance, out var kinematic) ? kinematic.Gap(position) : distance;
        }

        return TryFindClosestContact(position, maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;
    }

    /// <summary>Finds the closest obstacle, or the one that is overlapped most.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="closestContact">The obstacle, if there is one.</param>
    /// <returns>False where no obstacle is within the distance.</returns>
    public bool TryFindClosestContact(Vector position, double maxDistance, out Contact closestContact)
    {
        var isFound = TryFindClosestBody(position, ref maxDistance, out closestContact);
        // A body that is overlapped by more than the radius hides all surfaces.
        if (maxDistance < -_radius)
        {
            return isFound;
        }

        if (!(_safeDistance.LowerBoundAt(position) - _radius > maxDistance)
            && TryFindClosestSurface(position, maxDistance, out var surface))
        {
            closestContact = surface;
            maxDistance = surface.Gap(position);
            isFound = true;
        }

        if (TryFindCloserKinematic(position, ref maxDistance, out var kinematic))
        {
            closestContact = kinematic;
            isFound = true;
        }

        return isFound;
    }

    /// <summary>Adds contacts with all collected bodies that are touched.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="tolerance">Largest gap that counts as touching.</param>
    /// <param name="contacts">Receives the contacts.</param>
    public void AddTouchedBodies(Vector position, double tolerance, ContactSet contacts)
    {
        foreach (var candidate in _candidates)
        {
            for (var ball = 0; ball < bodies[candidate].BallCount; ball++)
            {
                var contact = CreateBodyContact(candidate, ball, Vector.Zero);
                if (contact.Gap(position) <= tolerance)
                {
                    contacts.Add(contact, position);
                }
            }
        }
    }

    private double FreeDistanceToBodies(Vector position, double maxDistance) =>
        TryFindClosestBody(position, ref maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;

    private bool TryFindClosestBody(Vector position, ref double maxDistance, out Contact closestContact)
    {
        closestContact = default;
        var isFound = false;
        foreach (var candidate in _candidates)
        {
            for (var ball = 0; ball < bodies[candidate].BallCount; ball++)
            {
                foreach (var sphere in _sphereOffsets)
                {
                    isFound |= TryUpdateClosest(CreateBodyContact(candidate, ball, sphere), position, ref maxDistance, ref closestContact);
                }
            }
        }

        if (_character is not { } character)
        {
            return isFound;
        }

        // To bodies, the character is as immovable as a wall.
        var combinedRadius = _radius + character.Description.Radius;
        foreach (var sphere in character.SphereOffsets)
        {
            var contact = new Contact(character.Position + sphere, combinedRadius, Vector.Zero, Contact.NoBody, IsFlat: false);
            isFound |= TryUpdateClosest(in contact, position, ref maxDistance, ref closestContact);
        }

        return isFound;
    }

    private static bool TryUpdateClosest(in Contact contact, Vector position, ref double maxDistance, ref Contact closestContact)
    {
        var gap = contact.Gap(position);
        if (!(gap <= maxDistance))
        {
            return false;
        }

        closestContact = contact;
        maxDistance = gap;
        return true;
    }

    private Contact CreateBodyContact(int candidate, int ball, Vector sphere)
    {
        var other = bodies[candidate];
        return new(other.BallCentre(ball), _radius + other.BallRadius(ball), sphere, candidate, IsFlat: false) { BodyBall = (byte)ball };
    }
}

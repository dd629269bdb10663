//! Scans the elements of a part's text one by one, with their lines.

use std::borrow::Cow;
use std::str::FromStr;

use quick_xml::{
    Reader, XmlVersion,
    events::{BytesStart, Event},
};

use super::error::{ThreeMfError, xml_fault};

/// A reader of the tags of a text, in their order.
pub struct Scanner<'a> {
    part: &'a str,
    text: &'a str,
    reader: Reader<&'a [u8]>,
}

/// A place in a package.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    part: &'a str,
    text: &'a str,
    /// Number of bytes read up to here.
    offset: usize,
}

/// A tag that opens or closes an element, or is an empty one.
pub struct Tag<'a> {
    /// Its place in the text.
    pub place: Place<'a>,
    /// Its kind.
    pub kind: Kind,
    content: BytesStart<'a>,
}

/// The kinds of tags.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The start of an element with content.
    Open,
    /// An element without content.
    Empty,
    /// The end of an element.
    Close,
}

impl<'a> Scanner<'a> {
    /// Starts at the beginning of a part's text.
    pub fn new(part: &'a str, text: &'a str) -> Self {
        Self {
            part,
            text,
            reader: Reader::from_str(text),
        }
    }

    /// Reads the next tag; `None` at the end of the text. Refuses a document type, because it
    /// could declare entities that grow without end.
    pub fn next_tag(&mut self) -> Result<Option<Tag<'a>>, ThreeMfError> {
        loop {
            let event = self.reader.read_event();
            let place = Place {
                part: self.part,
                text: self.text,
                offset: self.reader.buffer_position() as usize,
            };
            let (kind, content) = match event.map_err(|error| place.fault(&error.to_string()))? {
                Event::Start(start) => (Kind::Open, start),
                Event::Empty(start) => (Kind::Empty, start),
                Event::End(_) => (Kind::Close, BytesStart::new("")),
                Event::DocType(_) => return Err(place.document_type()),
                Event::Eof => return Ok(None),
                _ => continue,
            };
            return Ok(Some(Tag {
                place,
                kind,
                content,
            }));
        }
    }

    /// Returns the text between the tag that was just read and the next one.
    pub fn text(&self) -> &'a str {
        let start = self.reader.buffer_position() as usize;
        let rest = self.text.get(start..).unwrap_or_default();
        rest.split('<').next().unwrap_or_default()
    }

    /// Skips the content of the element that was just opened.
    pub fn skip(&mut self, opened: &Tag) -> Result<(), ThreeMfError> {
        let mut depth = usize::from(opened.kind == Kind::Open);
        while depth > 0 {
            match self.next_tag()?.map(|tag| tag.kind) {
                Some(Kind::Open) => depth += 1,
                Some(Kind::Close) => depth -= 1,
                Some(Kind::Empty) => {}
                None => return Err(self.truncated()),
            }
        }
        Ok(())
    }

    /// Calls `child` with every direct child of the element that was just opened. `child` must
    /// read or skip the content of the one it gets.
    pub fn children(
        &mut self,
        opened: &Tag,
        mut child: impl FnMut(&mut Self, Tag<'a>) -> Result<(), ThreeMfError>,
    ) -> Result<(), ThreeMfError> {
        if opened.kind != Kind::Open {
            return Ok(());
        }
        loop {
            match self.next_tag()?.ok_or_else(|| self.truncated())? {
                tag if tag.kind == Kind::Close => return Ok(()),
                tag => child(self, tag)?,
            }
        }
    }

    /// Makes the fault of a text that ends within an element.
    fn truncated(&self) -> ThreeMfError {
        let end = Place {
            part: self.part,
            text: self.text,
            offset: self.text.len(),
        };
        end.fault("the text ends before its elements do")
    }
}

impl Place<'_> {
    /// Returns the line of the place, from 1.
    fn line(&self) -> usize {
        let read = &self.text.as_bytes()[..self.offset.min(self.text.len())];
        1 + read.iter().filter(|&&byte| byte == b'\n').count()
    }

    fn fault(&self, reason: &str) -> ThreeMfError {
        xml_fault(self.part, self.line(), reason)
    }

    fn document_type(&self) -> ThreeMfError {
        ThreeMfError::DocumentType {
            part: self.part.to_owned(),
            line: self.line(),
        }
    }
}

/// Longest excerpt of a faulty attribute in a message, characters.
const MAX_EXCERPT_CHARS: usize = 40;

impl Tag<'_> {
    /// Returns its name without a prefix; empty for the end of an element.
    pub fn name(&self) -> &str {
        self.content.local_name().into_inner()
    }

    /// Returns the attribute with this full name; `None` if it is missing.
    pub fn get(&self, name: &str) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        self.find(|key| key == name)
    }

    /// Returns the first attribute with a prefix and this local name; `None` if there is none.
    pub fn get_prefixed(&self, name: &str) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        self.find(|key| key.split_once(':').is_some_and(|(_, local)| local == name))
    }

    /// Returns the value of the first attribute whose full name matches.
    fn find(&self, matches: impl Fn(&str) -> bool) -> Result<Option<Cow<'_, str>>, ThreeMfError> {
        for attribute in self.content.attributes() {
            let attribute = attribute.map_err(|error| self.place.fault(&error.to_string()))?;
            if matches(attribute.key.into_inner()) {
                let value = attribute.normalized_value(XmlVersion::Explicit1_0);
                return value
                    .map(Some)
                    .map_err(|error| self.place.fault(&error.to_string()));
            }
        }
        Ok(None)
    }

    /// Reads the number that an attribute must hold.
    pub fn number<T: FromStr>(&self, requirement: &Requirement) -> Result<T, ThreeMfError> {
        let text = self.get(requirement.attribute)?.unwrap_or_default();
        text.trim()
            .parse()
            .map_err(|_| self.attribute_fault(requirement, &text))
    }

    /// Makes the fault of an attribute that does not meet its requirement.
    pub fn attribute_fault(&self, requirement: &Requirement, found: &str) -> ThreeMfError {
        ThreeMfError::Attribute {
            part: self.place.part.to_owned(),
            line: self.place.line(),
            element: requirement.element,
            attribute: requirement.attribute,
            expected: requirement.expected,
            found: found.chars().take(MAX_EXCERPT_CHARS).collect(),
        }
    }

    /// Returns the prefixes that the element declares, each with its namespace.
    pub fn namespaces(&self) -> Vec<(String, String)> {
        let declared = self.content.attributes().flatten().filter_map(|attribute| {
            let prefix = attribute.key.into_inner().strip_prefix("xmlns:")?;
            Some((prefix.to_owned(), attribute.value.into_owned()))
        });
        declared.collect()
    }
}

/// The requirement on an attribute.
#[derive(Debug, Clone, Copy)]
pub struct Requirement {
    /// The element it belongs to.
    pub element: &'static str,
    /// Its name.
    pub attribute: &'static str,
    /// The value it must hold, in words.
    pub expected: &'static str,
}
